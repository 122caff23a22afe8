// A PNG as the PNG library, not Cairo, reads it.
#pragma once

#include <gtest/gtest.h>
#include <png.h>

#include <filesystem>
#include <vector>

#include "ripstop/output/colour.h"

namespace ripstop {

struct Png {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;

  /// The colour of a pixel within the rounding of a byte.
  bool shows(int x, int y, Colour colour) const {
    const unsigned char* pixel = rgb.data() + 3 * (static_cast<std::size_t>(y) * width + x);
    return std::abs(pixel[0] - 255 * colour.red) <= 1 && std::abs(pixel[1] - 255 * colour.green) <= 1 &&
           std::abs(pixel[2] - 255 * colour.blue) <= 1;
  }
};

inline Png read_png(const std::filesystem::path& path) {
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  Png png;
  if (!png_image_begin_read_from_file(&image, path.c_str())) {
    ADD_FAILURE() << path << ": " << image.message;
    return png;
  }
  image.format = PNG_FORMAT_RGB;
  png.rgb.resize(PNG_IMAGE_SIZE(image));
  EXPECT_TRUE(png_image_finish_read(&image, nullptr, png.rgb.data(), 0, nullptr)) << image.message;
  png.width = static_cast<int>(image.width);
  png.height = static_cast<int>(image.height);
  return png;
}

}  // namespace ripstop
