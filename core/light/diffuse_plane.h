// A matt plane on which an object lies or above which it hangs.
#pragma once

namespace scattermeter {

// What happens where a face of the object lies on the plane.
enum class PlaneContact {
  kAir,      // a thin gap of air: Fresnel's laws at the face, then the plane, at the same place
  kOptical,  // no gap: light meets the plane inside the material
  kBlack,    // a thin gap of air above a black spot: what leaves through the face is absorbed
};

// The plane z = z_mm, infinite, seen from above. It reflects the share `albedo` of the light that
// meets it diffusely (Lambert). Both z_mm and directions are those of the world.
struct DiffusePlane {
  double z_mm = 0;
  double albedo = 0;  // 0 .. 1
  PlaneContact contact = PlaneContact::kAir;

  // A face of an object of this size that is nearer to the plane than this lies on it, mm.
  static double touching_mm(double object_size_mm) { return 1e-4 * object_size_mm; }
};

}  // namespace scattermeter
