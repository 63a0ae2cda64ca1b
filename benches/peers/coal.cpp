// Signed distances of solids by coal, next to which `peers --space` stands: rates and wrong values of the pairs that
// `peers --space --pairs FILE` wrote. Needs coal 3 with its headers (packages `coal` and `cmeel-eigen` of PyPI).
//
//     P=$(python -c 'import cmeel,os;print(os.path.dirname(os.path.dirname(cmeel.__file__)))')/cmeel.prefix
//     g++ -O3 -march=native -std=c++17 -I$P/include -I$P/include/eigen3 benches/peers/coal.cpp -L$P/lib -lcoal
//     -Wl,-rpath,$P/lib -o coal && ./coal FILE
#include <coal/distance.h>
#include <coal/shape/geometric_shapes.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

using namespace coal;

struct Solid {
  std::unique_ptr<ShapeBase> shape;
  Transform3s pose;
};

// Centre, size, quaternion with the real part first, of any length.
static Solid box(const double *x) {
  Eigen::Quaterniond turn(x[6], x[7], x[8], x[9]);
  return {std::make_unique<Box>(x[3], x[4], x[5]), Transform3s(turn.normalized(), Vec3s(x[0], x[1], x[2]))};
}

// Ends of the segment inside, radius. coal's capsules lie along z.
static Solid capsule(const double *x) {
  Vec3s start(x[0], x[1], x[2]), end(x[3], x[4], x[5]);
  Vec3s way = end - start;
  auto turn = Eigen::Quaterniond::FromTwoVectors(Vec3s(0, 0, 1), way);
  return {std::make_unique<Capsule>(x[6], way.norm()), Transform3s(turn, 0.5 * (start + end))};
}

struct Pair {
  Solid a, b;
  double truth;
};

// Seconds of this thread: others may be on the machine.
static double seconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return now.tv_sec + now.tv_nsec * 1e-9;
}

static double signed_distance(const Pair &pair, double tolerance) {
  DistanceRequest request;
  request.enable_signed_distance = true;
  request.gjk_tolerance = request.epa_tolerance = tolerance;
  DistanceResult result;
  return distance(pair.a.shape.get(), pair.a.pose, pair.b.shape.get(), pair.b.pose, request, result);
}

int main(int count, char **words) {
  if (count != 2) {
    std::fprintf(stderr, "usage: coal FILE\n");
    return 2;
  }
  std::map<int, std::vector<Pair>> kinds;
  std::ifstream file(words[1]);
  for (std::string text; std::getline(file, text);) {
    std::istringstream line(text);
    int kind;
    line >> kind;
    std::vector<double> x;
    for (std::string word; line >> word;) x.push_back(std::stod(word));
    const size_t each = (x.size() - 1) / 2;
    auto of = kind == 2 ? capsule : box;
    kinds[kind].push_back({of(x.data()), of(x.data() + each), x.back()});
  }
  if (kinds.empty()) {
    std::fprintf(stderr, "no pairs in %s\n", words[1]);
    return 1;
  }
  std::printf("| kind | tolerance | pairs | ns a pair | wrong by 1e-9 of the size | largest error |\n| --- | --- | ---: | ---: | ---: | ---: |\n");
  for (auto &[kind, pairs] : kinds) {
    for (double tolerance : {1e-6, 1e-10}) {
      double best = INFINITY, most = 0;
      size_t wrong = 0;
      for (int run = 0; run < 3; run++) {
        wrong = 0;
        std::vector<double> found;
        found.reserve(pairs.size());
        const double from = seconds();
        for (const Pair &pair : pairs) found.push_back(signed_distance(pair, tolerance));
        best = std::min(best, seconds() - from);
        const double size = kind == 9 ? 4e6 : 4.0;
        for (size_t i = 0; i < pairs.size(); i++) {
          double error = std::abs(found[i] - pairs[i].truth) / size;
          if (!(error <= most)) most = error;
          if (!(error <= 1e-9)) wrong++;
        }
      }
      std::printf("| %d | %g | %zu | %.0f | %zu | %.1e |\n", kind, tolerance, pairs.size(),
                  best * 1e9 / pairs.size(), wrong, most);
    }
  }
}
