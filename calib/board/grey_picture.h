// A shot as one grey value per pixel, raw or picture.
#pragma once

#include <string>
#include <vector>

#include "capture/raw/raw_frame.h"

namespace scattermeter::calib {

struct GreyPicture {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> grey;  // row by row, any scale
  // Pixels of the camera's frame: frame_px = px_scale * px + px_offset.
  double px_scale = 1;
  double px_offset = 0;
  int frame_width_px = 0;
  int frame_height_px = 0;
  std::string make, model;  // of the camera, where a raw says so
};

// One grey value per 2 x 2 cell: the mean of its samples above black, each phase scaled to the same
// mean over the frame, so that the weight of a cell whose colours are lit differently lies in its
// middle (0.5, 0.5) as that of a white one does. Nothing is interpolated. An odd last row or
// column is left out.
GreyPicture grey_picture(const capture::RawFrame& frame);

// By the file's ending: jpg, jpeg, png, tif, tiff, bmp, pgm, ppm, webp through OpenCV, as stored
// (EXIF's rotation is not applied: a lens belongs to the sensor), colours to grey, the values
// linear or not as they are; anything else is a raw (capture/raw/raw_reader.h). Throws InputError
// naming the file, also where it claims more than `max_megapixels`, before memory is taken for it.
GreyPicture read_grey_picture(const std::string& path, double max_megapixels);

}  // namespace scattermeter::calib
