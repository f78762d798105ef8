// The extension module scattermeter._native: the library calls and the forward models of core.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <oneapi/tbb/global_control.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "apps/checking/check.h"
#include "apps/export/export_formats.h"
#include "apps/instrument/calibration_inputs.h"
#include "apps/instrument/measure.h"
#include "apps/planning/plan.h"
#include "apps/python/bindings.h"
#include "apps/python/python_progress.h"
#include "apps/report/check_json.h"
#include "apps/report/plan_json.h"
#include "apps/results/result_json.h"
#include "apps/results/result_reader.h"
#include "apps/rig/led_calibration_file.h"
#include "apps/rig/radiance_file.h"
#include "apps/rig/rig.h"
#include "apps/simulation/simulate.h"
#include "calib/lens/camera_calibration_file.h"
#include "calib/lens/lens_of_points.h"
#include "calib/pose/shot_pose.h"
#include "capture/files/pending_file.h"
#include "core/base/input_error.h"
#include "core/base/version.h"

namespace py = pybind11;

namespace scattermeter::python {
namespace {

using Limit = std::optional<tbb::global_control>;

// Limits the number of threads during its lifetime; empty: all cores.
void limit_threads(const std::optional<int>& threads, Limit& limit) {
  if (!threads) return;
  limit.emplace(tbb::global_control::max_allowed_parallelism,
                static_cast<std::size_t>(std::max(1, *threads)));
}

std::string measure(const std::string& shots, const std::string& rig, const std::string& model,
                    std::optional<double> patch_size_mm, double time_limit_s,
                    const std::vector<std::string>& materials, const std::string& channels,
                    const std::string& cache, std::optional<int> threads,
                    const py::object& progress) {
  apps::MeasureOptions options;
  options.estimate.model = estimator(model).name;
  options.estimate.time_limit_s = time_limit_s;
  options.estimate.channels = channels;
  options.patch_size_mm = patch_size_mm;
  options.materials = materials;
  options.cache_folder = cache;
  std::string json;
  run_interruptible(progress, [&](Progress& p) {
    Limit limit;
    limit_threads(threads, limit);
    json = apps::result_json(apps::measure(apps::read_rig(rig), shots, options, &p), "");
  });
  return json;
}

std::string check(const std::string& shots, const std::string& rig, const py::object& progress) {
  std::string json;
  run_interruptible(progress, [&](Progress& p) {
    json = apps::check_json(apps::check(apps::read_rig(rig), shots, {}, &p), "");
  });
  return json;
}

std::vector<std::string> simulate(const std::string& rig, const std::string& out, bool volume,
                                  std::int64_t paths, std::uint64_t seed, bool noise,
                                  const py::object& progress) {
  apps::SimulateOptions options;
  options.seed = seed;
  options.noise = noise;
  options.transport.volume = volume;
  options.transport.paths = paths;
  std::vector<std::string> written;
  run_interruptible(progress, [&](Progress& p) {
    written = apps::simulate(apps::read_rig(rig), out, options, &p).paths;
  });
  return written;
}

std::string plan(const std::string& rig, bool other_shots, const py::object& progress) {
  apps::PlanOptions options;
  options.suggested_shots = other_shots;
  std::string json;
  run_interruptible(progress, [&](Progress& p) {
    json = apps::plan_json(apps::plan(apps::read_rig(rig), options, &p), "");
  });
  return json;
}

// Returns the text of the file for camera.intrinsics.
std::string calibrate_camera(const std::string& shots, const std::string& rig,
                             const py::object& progress) {
  calib::CameraCalibrationRun run;
  run_interruptible(progress, [&](Progress&) {
    run = calib::calibrate_camera_shots(apps::camera_calibration_input(rig, shots));
  });
  if (run.calibration.status != calib::CameraCalibrationStatus::kOk) {
    throw InputError(shots, "the shots do not determine the lens: " + run.calibration.message);
  }
  return calib::camera_calibration_text(run.calibration, {});
}

// Returns the text of the file for lights.NAME.calibration.
std::string calibrate_led(const std::string& shots, const std::string& rig_path,
                          const std::string& light, const py::object& progress) {
  calib::LedCalibration calibration;
  run_interruptible(progress, [&](Progress&) {
    apps::Rig rig = apps::read_rig(rig_path);
    calib::take_points_and_lens(rig.scene, rig.decoding, shots, rig.pose);
    calibration = calib::calibrate_led(apps::led_calibration_input(rig), light,
                                       apps::led_frames_in(rig, shots));
  });
  if (calibration.fit.status != calib::LedStatus::kOk) {
    throw InputError(shots, "the shots do not determine the LED " + light);
  }
  return apps::led_calibration_yaml(calibration);
}

// Returns the text of the file for camera.radiance.
std::string calibrate_radiance(const std::string& shots, const std::string& rig_path,
                               const py::object& progress) {
  std::string text;
  run_interruptible(progress, [&](Progress&) {
    apps::Rig rig = apps::read_rig(rig_path, false);
    if (rig.calibration.radiance && rig.calibration.radiance->white) {
      calib::take_points_from_board_shot(rig.scene, rig.decoding, shots, rig.pose);
    }
    text = apps::radiance_file_text(calib::calibrate_radiance(
        apps::radiance_calibration_input(rig), apps::radiance_frames_in(rig, shots)));
  });
  return text;
}

void export_materials(const std::string& result_path, const std::string& format,
                      const std::string& out, const std::vector<std::string>& names,
                      std::optional<double> mm_per_unit, double g) {
  const apps::ReadResult result = apps::read_result(result_path);
  const std::vector<apps::MeasuredMaterial> materials = apps::materials_of(result, names);
  for (const apps::ExportFormat& f : apps::kExportFormats) {
    if (format != f.name) continue;
    const std::vector<std::string> refused = apps::refusals(materials);
    if (!refused.empty() && !f.takes_refused) throw InputError(result_path, refused.front());
    capture::write_text_file(out,
                             f.text(result, materials, {mm_per_unit.value_or(f.mm_per_unit), g}));
    return;
  }
  throw InputError("format", "there is no export format " + format);
}

}  // namespace
}  // namespace scattermeter::python

PYBIND11_MODULE(_native, module) {
  using namespace scattermeter::python;
  module.doc() =
      "The instrument's calls and core's forward models; see the package's own functions.";
  module.attr("__version__") = scattermeter::kVersion;
  static py::exception<scattermeter::InputError> input_error(module, "InputError",
                                                             PyExc_ValueError);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const scattermeter::MissingFile& e) {
      PyErr_SetString(PyExc_FileNotFoundError, e.what());
    } catch (const scattermeter::InputError& e) {
      input_error(e.what());
    } catch (const scattermeter::Cancelled&) {
      PyErr_SetNone(PyExc_KeyboardInterrupt);
    }
  });
  module.def("measure", &measure, py::arg("shots"), py::arg("rig"), py::arg("model"),
             py::arg("patch_size_mm"), py::arg("time_limit_s"), py::arg("materials"),
             py::arg("channels"), py::arg("cache"), py::arg("threads"), py::arg("progress"));
  module.def("check", &check, py::arg("shots"), py::arg("rig"), py::arg("progress"));
  module.def("simulate", &simulate, py::arg("rig"), py::arg("out"), py::arg("volume"),
             py::arg("paths"), py::arg("seed"), py::arg("noise"), py::arg("progress"));
  module.def("plan", &plan, py::arg("rig"), py::arg("other_shots"), py::arg("progress"));
  module.def("calibrate_camera", &calibrate_camera, py::arg("shots"), py::arg("rig"),
             py::arg("progress"));
  module.def("calibrate_led", &calibrate_led, py::arg("shots"), py::arg("rig"), py::arg("light"),
             py::arg("progress"));
  module.def("calibrate_radiance", &calibrate_radiance, py::arg("shots"), py::arg("rig"),
             py::arg("progress"));
  module.def("export", &export_materials, py::arg("result"), py::arg("format"), py::arg("out"),
             py::arg("materials"), py::arg("mm_per_unit"), py::arg("g"));
  module.def(
      "write_text_file",
      [](const std::string& path, const std::string& text) {
        scattermeter::capture::write_text_file(path, text);
      },
      py::arg("path"), py::arg("text"));
  add_models(module);
  add_estimate(module);
}
