// Light of transport by body, view, light and sigma_s, shared by all materials and channels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "core/atlas/atlas_store.h"
#include "core/light/diffuse_plane.h"
#include "core/light/entry_source.h"
#include "core/material/phase_function.h"
#include "core/scene/scene.h"
#include "core/scene/seen_object.h"
#include "core/transport/camera_connection.h"
#include "core/transport/path_boundary.h"
#include "core/transport/white_rows.h"

namespace scattermeter {

// What the paths of an object need to know of its medium, besides sigma_s'.
struct AtlasMedium {
  double eta_int_over_ext = 1;
  PhaseFunction phase = {};
  double surface_alpha = 0;
};

// Nodes stand at fixed values of sigma_s', evenly in its logarithm, and are traced when they are
// asked for. Seeds follow from what a node is of, so that the same levels have the same digits
// whoever asked for them, and in whatever order. Several threads may use it at once if none traces:
// others would wait for it, and what they hold of the node would change.
//
// Views whose camera centres, seen from the object, are at most kNearViews apart share their nodes:
// l is the light inside (core/transport/camera_connection.h), which between two such directions
// changes by some 1e-4 of itself. In diffuse light, 1 + 1.5 mu along the cosine mu to the surface,
// and by most, 3e-4, at an eta of 1.5 and 45 degrees.
class TransportAtlas {
 public:
  // Between neighbouring nodes, of log sigma_s.
  static constexpr double kSpacing = 0.35;
  static double sigma_s_per_mm(int node);  // sigma_s'
  // rad
  static constexpr double kNearViews = 1e-3;
  // With a store, so many nodes of a light and view are in memory beside those that somebody holds:
  // the four of a point, and some to move among. Others are read again.
  static constexpr std::size_t kHeldNodes = 6;

  // store: of nodes, null: only in memory.
  explicit TransportAtlas(std::shared_ptr<AtlasStore> store = nullptr) : store_(std::move(store)) {}

  // One light on one object, as the camera sees it.
  class LitView {
   public:
    // Rows of the nodes: all patches that face the camera.
    Eigen::Index row_of_patch(int patch) const {
      return view_->rows.row_of_patch[static_cast<std::size_t>(patch)];
    }
    double size_mm() const { return view_->boundary->size_mm(); }
    // The node with at least so many levels, traced if need be. levels >= 1.
    std::shared_ptr<const WhiteRows> node(int idx, int levels);
    // Paths to be traced for that.
    std::int64_t missing_paths(int idx, int levels) const;

   private:
    friend class TransportAtlas;
    struct View {
      const ObjectScene* object = nullptr;
      const PatchMesh* patches = nullptr;
      double eta = 1;                                       // int over ext
      Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();  // of the camera
      std::unique_ptr<PathBoundary> boundary;
      std::optional<CameraConnection> camera;  // of some medium
      ScatteringView rows;
      double surface_alpha = 0;
      bool shows(const SeenObject& seen, const AtlasMedium& medium) const;
    };
    // The atlas is locked in its turn.
    const std::shared_ptr<WhiteRows>& known_node(int idx) const;

    const View* view_ = nullptr;
    const SceneLight* light_ = nullptr;
    PhaseFunction phase_;
    int channel_ = -1;    // -1: the same in all
    DiffusePlane plane_;  // below the object
    std::unique_ptr<EntrySource> source_;
    std::uint64_t seed_ = 0;
    AtlasStore* store_ = nullptr;
    std::string body_;              // its name in the store
    std::mutex* in_use_ = nullptr;  // of the atlas
    mutable std::map<int, std::shared_ptr<WhiteRows>> nodes_;
  };

  // Of unit power. Scene and objects are the same in all calls, and outlive the atlas. Throws
  // InputError if the light reaches no part of the object. The reference stays valid.
  LitView& lit_view(const Scene& scene, const SeenObject& seen, const SceneLight& light,
                    std::size_t channel, const AtlasMedium& medium);

 private:
  using View = LitView::View;
  const View& view(const SeenObject& seen, const Eigen::Vector3d& center_mm,
                   const AtlasMedium& medium);
  std::mutex in_use_;
  std::shared_ptr<AtlasStore> store_;
  std::list<View> views_;
  std::list<LitView> lit_;
};

}  // namespace scattermeter
