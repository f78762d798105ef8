#include "apps/virtual_sensor.h"

#include "capture/decoded_frame.h"
#include "capture/tone_curve.h"

namespace scattermeter::apps {

// FNV-1a (Fowler, Noll, Vo), 64 bits.
std::uint64_t VirtualSensor::stream(std::uint64_t seed, const std::string& file) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : file) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return hash ^ (seed * 0x9e3779b97f4a7c15ULL);
}

std::vector<std::uint16_t> VirtualSensor::codes(const std::vector<float>& signal_counts,
                                                double /*stated_s*/, std::uint64_t stream) const {
  const calib::CameraIntrinsics& k = rig_.camera.intrinsics;
  return capture::expose(signal_counts, k.width_px, k.height_px, model(), stream);
}

capture::RawFrame VirtualSensor::frame(const std::vector<float>& signal_counts, double stated_s,
                                       std::uint64_t stream) const {
  const calib::CameraIntrinsics& k = rig_.camera.intrinsics;
  return capture::decoded_frame(k.width_px, k.height_px, codes(signal_counts, stated_s, stream),
                                metadata(stated_s));
}

void VirtualSensor::write(const std::string& path, const std::vector<float>& signal_counts,
                          double stated_s, std::uint64_t stream) const {
  const calib::CameraIntrinsics& k = rig_.camera.intrinsics;
  capture::write_dng(path, k.width_px, k.height_px, codes(signal_counts, stated_s, stream),
                     metadata(stated_s));
}

capture::SensorModel VirtualSensor::model() const {
  const RigSensor& from = rig_.camera.sensor;
  capture::SensorModel sensor;
  sensor.noise = from.noise;
  sensor.black_counts = from.black_counts;
  sensor.white_counts = from.white_counts;
  if (from.nef_lossy_curve) sensor.tone_curve = capture::nef_lossy_curve();
  sensor.noise_on = noise_;
  return sensor;
}

capture::DngMetadata VirtualSensor::metadata(double stated_s) const {
  const RigCamera& camera = rig_.camera;
  capture::DngMetadata metadata;
  // "NIKON D80" is model D80 by NIKON; cameras write both tags with the maker's name in the model.
  if (!camera.model.empty()) {
    metadata.model = camera.model;
    metadata.make = camera.model.substr(0, camera.model.find(' '));
  }
  metadata.cfa = camera.sensor.cfa;
  metadata.black_counts = camera.sensor.black_counts;
  metadata.white_counts = camera.sensor.white_counts;
  metadata.exposure_s = stated_s;
  metadata.iso = camera.iso;
  metadata.f_number = camera.f_number;
  if (camera.sensor.nef_lossy_curve) metadata.linearization_table = capture::nef_lossy_curve();
  return metadata;
}

}  // namespace scattermeter::apps
