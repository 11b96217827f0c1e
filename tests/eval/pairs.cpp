// All ordered pairs of gallery edits of a model, one on the other or on itself: what they keep together of what each keeps alone, as
// they were propagated and composed. Prints CSV `benchmark,case,metric,value`; with --each what every pair loses.
//   cmake --build --preset native-release --target parsel_pairs && build/native-release/tests/eval/parsel_pairs
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string_view>

#include "tests/core/pairs_measure.h"

using namespace parsel;

int main(int argc, char** argv) {
  const bool each = argc > 1 && std::string_view(argv[1]) == "--each";
  test::Kept plain, composed;
  std::vector<double> times;
  for (const GalleryModel& model : gallery_models()) {
    const test::GalleryLayers layers = test::gallery_layers(model);
    for (std::size_t a = 0; a < layers.edits.size(); ++a) {
      for (std::size_t b = 0; b < layers.edits.size(); ++b) {
        const Program before = test::side_by_side(layers.edits[a], layers.edits[b]);
        if (!validate(before, layers.shape).ok()) {
          std::printf("pairs,%s/%s+%s,refused,1\n", model.id.c_str(), layers.ids[a].c_str(), layers.ids[b].c_str());
          continue;
        }
        const auto start = std::chrono::steady_clock::now();
        const Program after = compose(layers.shape, before);
        times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
        std::string lost;
        const test::Kept was = test::kept_together(layers.shape, before);
        const test::Kept is = test::kept_together(layers.shape, after, &lost);
        plain += was;
        composed += is;
        if (each && (!lost.empty() || is.together < was.together || is.inverted > was.inverted)) {
          std::printf("%s/%s+%s: %d of %d, %d alone, %.0f ms, inverted %d (%d):%s\n", model.id.c_str(),
                      layers.ids[a].c_str(), layers.ids[b].c_str(), is.together, is.of, was.together, times.back(),
                      is.inverted, was.inverted, lost.c_str());
          std::fflush(stdout);
        }
      }
    }
  }
  std::sort(times.begin(), times.end());
  const auto share = [](const test::Kept& kept) { return 100.0 * kept.together / kept.of; };
  std::printf("pairs,all,pairs,%zu\n", times.size());
  std::printf("pairs,as propagated,kept together (%%),%.2f\n", share(plain));
  std::printf("pairs,composed,kept together (%%),%.2f\n", share(composed));
  std::printf("pairs,as propagated,inverted boxes,%d\n", plain.inverted);
  std::printf("pairs,composed,inverted boxes,%d\n", composed.inverted);
  std::printf("pairs,composing,median (ms),%.1f\n", times[times.size() / 2]);
  std::printf("pairs,composing,95th percentile (ms),%.1f\n", times[times.size() * 95 / 100]);
  std::printf("pairs,composing,slowest (ms),%.1f\n", times.back());
}
