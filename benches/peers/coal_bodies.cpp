// Signed distances of curved bodies and hulls by coal, next to which `peers --bodies FILE` stands: processor nanoseconds
// call by call, by the tolerances of GJK and EPA, and the differences from geograd's values, which FILE has. Needs what
// `coal.cpp` needs, and is compiled in the same way.
#include <coal/distance.h>
#include <coal/shape/convex.h>
#include <coal/shape/geometric_shapes.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

using namespace coal;

struct Solid {
  std::shared_ptr<ShapeBase> shape;
  Transform3s pose;
};

struct Pair {
  Solid a, b;
  double truth;
};

static Solid body(std::istringstream &in) {
  char kind;
  in >> kind;
  const auto number = [&] {
    double x;
    in >> x;
    return x;
  };
  const auto vector = [&] {
    const double x = number(), y = number(), z = number();
    return Vec3s(x, y, z);
  };
  if (kind == 'E' || kind == 'B') {
    const Vec3s center = vector(), size = vector();
    const double w = number(), x = number(), y = number(), z = number();
    const Transform3s pose(Eigen::Quaterniond(w, x, y, z).normalized(), center);
    if (kind == 'E') return {std::make_shared<Ellipsoid>(size), pose};
    return {std::make_shared<Box>(size[0], size[1], size[2]), pose};
  }
  if (kind == 'H') {
    auto points = std::make_shared<std::vector<Vec3s>>();
    for (int k = 0; k < 8; k++) points->push_back(vector());
    return {std::shared_ptr<ShapeBase>(ConvexBase::convexHull(points, 8, true, "Qt")), Transform3s()};
  }
  // Coal's cylinders and cones lie along z, around the middle.
  const Vec3s start = vector(), end = vector();
  const double radius = number();
  const Vec3s up = kind == 'O' ? Vec3s(start - end) : Vec3s(end - start);
  const Transform3s pose(Eigen::Quaterniond::FromTwoVectors(Vec3s(0, 0, 1), up), 0.5 * (start + end));
  if (kind == 'O') return {std::make_shared<Cone>(radius, up.norm()), pose};
  return {std::make_shared<Cylinder>(radius, up.norm()), pose};
}

// Seconds of this thread: others may be on the machine.
static double seconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return now.tv_sec + now.tv_nsec * 1e-9;
}

int main(int count, char **words) {
  if (count != 2) {
    std::fprintf(stderr, "usage: coal_bodies FILE\n");
    return 2;
  }
  std::vector<std::pair<std::string, std::vector<Pair>>> kinds;
  std::ifstream file(words[1]);
  for (std::string text; std::getline(file, text);) {
    std::istringstream line(text);
    std::string name;
    line >> name;
    if (kinds.empty() || kinds.back().first != name) kinds.push_back({name, {}});
    Pair pair;
    pair.a = body(line);
    pair.b = body(line);
    line >> pair.truth;
    kinds.back().second.push_back(pair);
  }
  if (kinds.empty()) {
    std::fprintf(stderr, "no pairs in %s\n", words[1]);
    return 1;
  }
  std::printf("| bodies | tolerance | ns | median difference over the size | beyond 1e-9 |\n| --- | --- | ---: | ---: | ---: |\n");
  for (auto &[name, pairs] : kinds) {
    for (double tolerance : {1e-6, 1e-9, 1e-12, 1e-14}) {
      DistanceRequest request;
      request.enable_signed_distance = true;
      request.gjk_tolerance = request.epa_tolerance = tolerance;
      request.gjk_max_iterations = 10000;
      request.epa_max_iterations = 1000;
      double best = INFINITY;
      std::vector<double> errors;
      for (int run = 0; run < 5; run++) {
        std::vector<double> found;
        found.reserve(pairs.size());
        const double from = seconds();
        for (const Pair &pair : pairs) {
          DistanceResult result;
          found.push_back(distance(pair.a.shape.get(), pair.a.pose, pair.b.shape.get(), pair.b.pose, request, result));
        }
        best = std::min(best, seconds() - from);
        errors.clear();
        for (size_t k = 0; k < pairs.size(); k++) {
          const double error = std::abs(found[k] - pairs[k].truth) / 2;
          errors.push_back(std::isfinite(error) ? error : INFINITY);
        }
      }
      std::sort(errors.begin(), errors.end());
      const auto wrong = std::count_if(errors.begin(), errors.end(), [](double error) { return error > 1e-9; });
      std::printf("| %s | %g | %.0f | %.1e | %ld of %zu |\n", name.c_str(), tolerance, best * 1e9 / pairs.size(),
                  errors[errors.size() / 2], long(wrong), pairs.size());
    }
  }
}
