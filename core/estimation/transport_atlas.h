// Light of transport by body, view, light and sigma_s, shared by all materials and channels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <optional>

#include "core/light/diffuse_plane.h"
#include "core/light/entry_source.h"
#include "core/scene/scene.h"
#include "core/scene/seen_object.h"
#include "core/transport/camera_connection.h"
#include "core/transport/path_boundary.h"
#include "core/transport/white_rows.h"

namespace scattermeter {

// Nodes stand at fixed values of sigma_s, evenly in its logarithm, and are traced when they are
// asked for. Seeds follow from what a node is of, so that the same levels have the same digits
// whoever asked for them, and in whatever order. Not to be used from several threads at once.
class TransportAtlas {
 public:
  // Between neighbouring nodes, of log sigma_s.
  static constexpr double kSpacing = 0.35;
  static double sigma_s_per_mm(int node);

  // One light on one object, as the camera sees it.
  class LitView {
   public:
    const ScatteringView& rows() const { return view_->rows; }
    double size_mm() const { return view_->boundary->size_mm(); }
    // The node with at least so many levels. levels >= 1.
    const WhiteRows& node(int idx, int levels);
    // Paths to be traced for that.
    std::int64_t missing_paths(int idx, int levels) const;

   private:
    friend class TransportAtlas;
    struct View {
      std::shared_ptr<const SeenObject> seen;
      std::unique_ptr<PathBoundary> boundary;
      std::optional<CameraConnection> camera;  // of some medium
      ScatteringView rows;
    };
    const View* view_ = nullptr;
    const SceneLight* light_ = nullptr;
    int channel_ = -1;  // -1: the same in all
    double eta_ = 1;
    DiffusePlane plane_;  // below the object
    std::unique_ptr<EntrySource> source_;
    std::uint64_t seed_ = 0;
    std::map<int, WhiteRows> nodes_;
  };

  // Of unit power. The scene is the same in all calls, and outlives the atlas. Throws InputError if
  // the light reaches no part of the object. The reference stays valid.
  LitView& lit_view(const Scene& scene, const std::shared_ptr<const SeenObject>& seen,
                    const SceneLight& light, std::size_t channel, double eta_int_over_ext);

 private:
  const LitView::View& view(const std::shared_ptr<const SeenObject>& seen, double eta_int_over_ext);
  std::list<LitView::View> views_;
  std::list<LitView> lit_;
};

}  // namespace scattermeter
