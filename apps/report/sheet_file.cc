#include "apps/report/sheet_file.h"

#include <cmath>
#include <memory>

#include <cairo-pdf.h>
#include <cairo.h>

#include "capture/files/pending_file.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

constexpr double kPointsPerMm = 72.0 / 25.4;
constexpr double kPixelsPerMm = 600.0 / 25.4;

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Canvas = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

// In mm, y up.
void draw(cairo_t* to, const Sheet& sheet, double units_per_mm) {
  cairo_scale(to, units_per_mm, -units_per_mm);
  cairo_translate(to, 0.0, -sheet.height_mm);
  cairo_set_source_rgb(to, 1.0, 1.0, 1.0);
  cairo_paint(to);
  cairo_set_source_rgb(to, 0.0, 0.0, 0.0);
  for (const SheetRectangle& r : sheet.black) {
    cairo_rectangle(to, r.min_mm.x(), r.min_mm.y(), r.max_mm.x() - r.min_mm.x(),
                    r.max_mm.y() - r.min_mm.y());
  }
  cairo_fill(to);
  for (const SheetLine& line : sheet.lines) {
    const double grey = line.white ? 1.0 : 0.0;
    cairo_set_source_rgb(to, grey, grey, grey);
    cairo_set_line_width(to, line.width_mm);
    for (const Eigen::Vector2d& p : line.points_mm) cairo_line_to(to, p.x(), p.y());
    cairo_stroke(to);
  }
  cairo_set_source_rgb(to, 0.0, 0.0, 0.0);
  cairo_select_font_face(to, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  for (const SheetText& text : sheet.texts) {
    cairo_save(to);
    cairo_translate(to, text.start_mm.x(), text.start_mm.y());
    cairo_scale(to, 1.0, -1.0);
    cairo_set_font_size(to, text.size_mm);
    cairo_move_to(to, 0.0, 0.0);
    cairo_show_text(to, text.text.c_str());
    cairo_restore(to);
  }
}

cairo_status_t append(void* to, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void check(cairo_status_t status, const std::string& path) {
  if (status != CAIRO_STATUS_SUCCESS) {
    throw InputError(path, std::string("cannot be drawn: ") + cairo_status_to_string(status));
  }
}

}  // namespace

void write_sheet(const std::string& path, const Sheet& sheet) {
  const bool pdf = path.ends_with(".pdf");
  if (!pdf && !path.ends_with(".png")) throw InputError(path, "must end with .pdf or .png");
  std::string bytes;
  const auto pixels = [](double mm) { return static_cast<int>(std::lround(mm * kPixelsPerMm)); };
  const Surface surface(
      pdf ? cairo_pdf_surface_create_for_stream(append, &bytes, sheet.width_mm * kPointsPerMm,
                                                sheet.height_mm * kPointsPerMm)
          : cairo_image_surface_create(CAIRO_FORMAT_RGB24, pixels(sheet.width_mm),
                                       pixels(sheet.height_mm)),
      &cairo_surface_destroy);
  const Canvas canvas(cairo_create(surface.get()), &cairo_destroy);
  draw(canvas.get(), sheet, pdf ? kPointsPerMm : kPixelsPerMm);
  check(cairo_status(canvas.get()), path);
  if (!pdf) check(cairo_surface_write_to_png_stream(surface.get(), append, &bytes), path);
  cairo_surface_finish(surface.get());
  check(cairo_surface_status(surface.get()), path);
  capture::write_text_file(path, bytes);
}

}  // namespace scattermeter::apps
