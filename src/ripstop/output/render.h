// Shaded surfaces and lines as pixels: a depth buffer with smooth normals, no display needed.
#pragma once

#include <cstdint>
#include <vector>

#include "ripstop/core/vec3.h"
#include "ripstop/output/colour.h"

namespace ripstop::inline output {

struct SceneLine {
  int a = 0, b = 0;  // its end points
  double width = 1;  // [pixel]
  Colour colour = ink;
};
struct Scene {
  std::vector<Vec3> points;  // [m]
  struct Quad {
    int corner[4];
    Colour colour;
  };
  std::vector<Quad> quads;
  std::vector<SceneLine> lines;
};

/// right x up = toward_eye, unit vectors. Image-plane coordinates (u, v) [m] are measured from `target`.
struct Camera {
  Vec3 target, right{1, 0, 0}, up{0, 1, 0}, toward_eye{0, 0, 1};
  double distance = 0;  // eye to target; 0: parallel projection [m]
  double u = 0, v = 0;  // centre of the picture on the plane through `target` [m]
  double height = 1;    // of the picture on that plane [m]
};
/// A camera that looks from `toward_eye` (any length) with the picture's upper edge toward `up`.
Camera camera_from(Vec3 target, Vec3 toward_eye, Vec3 up, double distance);
/// The same view with all `points` inside a picture of this width / height, and `margin` of its size round
/// them. Throws Error(bad_data) without points.
Camera fitted(Camera camera, const std::vector<Vec3>& points, double aspect, double margin);

/// Pixel coordinates, y downward, (0, 0) the upper left corner of the first pixel. The depth is linear on the
/// picture and grows away from the eye. Points at or behind the eye are not `visible`.
struct Projected {
  double x = 0, y = 0, depth = 0;
  bool visible = true;
};
Projected project(const Camera& camera, Vec3 point, int width, int height);

struct Raster {
  int width = 0, height = 0;
  std::vector<std::uint32_t> argb;  // alpha in the highest byte, premultiplied; row by row from the top
};
/// Every pixel is the mean of samples x samples rays. Where nothing is hit it is transparent.
/// Quads are lit from the upper left of the eye on both sides, with normals averaged over the cells at a
/// point, and outlined where the surface behind is clearly farther away.
Raster render(const Scene& scene, const Camera& camera, int width, int height, int samples = 3);

}  // namespace ripstop::inline output
