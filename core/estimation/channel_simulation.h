// Simulation of the shots of one channel by volume Monte Carlo.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/estimation/channel_rows.h"
#include "core/fit/scattering_equation.h"
#include "core/light/diffuse_plane.h"
#include "core/light/entry_source.h"
#include "core/transport/camera_connection.h"
#include "core/transport/path_boundary.h"
#include "core/transport/scattering_rows.h"

namespace scattermeter {

// Shots that see an object under the same light share its paths. Scene and channel must outlive
// the object.
class ChannelSimulation {
 public:
  // Throws InputError if a light reaches no part of an object.
  ChannelSimulation(const Scene& scene, const MaterialChannel& channel);

  // From now on, images and projections have the rows whose state is kUsed, shot by shot.
  void set_rows(const ChannelRows& rows);
  Eigen::Index n_rows() const { return static_cast<Eigen::Index>(area_mm2_.size()); }
  // By row, of its patch.
  const std::vector<double>& area_mm2() const { return area_mm2_; }
  const std::vector<Eigen::Vector3d>& center_mm() const { return center_mm_; }

  // A sample of paths for one medium; initially empty.
  struct Draw {
    std::vector<ScatteringSum> of_light;
    std::vector<std::vector<Eigen::Index>> projected;  // projection's rows, by light
    Eigen::Index n_projected = 0;
    std::uint64_t seed = 0;
    int blocks() const { return of_light.front().blocks(); }
  };
  // projection: a matrix whose columns are the rows of the images. No two draws share a path.
  Draw draw(const Eigen::MatrixXd& projection);
  void trace(Draw& draw, const ScatteringPoint& at, int blocks) const;
  // At scale 1, W/mm^2.
  ScatteringImage image(const Draw& draw) const;
  // Of projection * image.
  static Eigen::MatrixXd covariance(const Draw& draw);

 private:
  struct View {
    std::unique_ptr<PathBoundary> boundary;
    std::optional<CameraConnection> camera;  // of some medium
    ScatteringView rows;
    DiffusePlane plane;  // below the object
  };
  // One light on one object, as the camera sees it.
  struct LitView {
    const SeenObject* seen;
    const SceneLight* light;
    const View* view;
    std::unique_ptr<EntrySource> source;
    double power;
    std::vector<std::size_t> shots;
    // Pairs of a row of the images that it lights and the same row of the view.
    std::vector<std::pair<Eigen::Index, Eigen::Index>> rows;
  };

  const MaterialChannel& channel_;
  std::map<const SeenObject*, View> views_;
  std::vector<LitView> lit_;
  std::vector<double> area_mm2_;
  std::vector<Eigen::Vector3d> center_mm_;
  std::uint64_t draws_ = 0;
};

}  // namespace scattermeter
