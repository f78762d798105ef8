// Shots, raw files or pictures, as one grey value per pixel.
#pragma once

#include <string>
#include <vector>

#include "capture/raw/raw_frame.h"

namespace scattermeter::calib {

struct GreyPicture {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> grey;  // row by row, any scale
  // Conversion to pixels of the camera's frame: frame_px = px_scale * px + px_offset.
  double px_scale = 1;
  double px_offset = 0;
  int frame_width_px = 0;
  int frame_height_px = 0;
  std::string make, model;  // of the camera, if a raw file states them
};

// One grey value per 2 x 2 cell: the mean of its samples above black, with each phase scaled to the
// same mean over the frame, so that under coloured light, too, the centroid of the weights is the
// centre of the cell (0.5, 0.5). Nothing is interpolated. An odd last row or column is omitted.
GreyPicture grey_picture(const capture::RawFrame& frame);

// Reads a file according to its extension: jpg, jpeg, png, tif, tiff, bmp, pgm, ppm and webp
// through OpenCV, as stored (without the EXIF rotation, since the lens parameters refer to the
// sensor), with colours converted to grey and the values left as they are, linear or not; anything
// else as a raw file (capture/raw/raw_reader.h). Throws InputError naming the file, also if it
// claims more than `max_megapixels`, before memory is allocated for it.
GreyPicture read_grey_picture(const std::string& path, double max_megapixels);

}  // namespace scattermeter::calib
