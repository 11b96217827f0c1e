// parsel offers: sliders that geometry and labels alone can offer, checked and clean.
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/check/check.h"
#include "core/cli/command.h"
#include "core/cli/input.h"
#include "core/infer/plain_offers.h"
#include "core/propagate/clean.h"

namespace parsel::cli {
namespace {

using nlohmann::json;

int run(const Arguments& arguments) {
  if (arguments.positional.size() != 1) return misuse("offers takes one model");
  const Result<Shape> shape = read_shape(arguments.positional[0]);
  if (!shape.ok()) return refuse(shape.error());
  json offers = json::array(), left = json::array();
  for (const PlainOffer& offer : plain_offers(*shape)) {
    PropagateOptions options;
    options.request = offer.title;
    const auto start = std::chrono::steady_clock::now();
    const Result<Propagation> found = propagate_cleanly(*shape, offer.edit, options);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    if (!found.ok()) {
      left.push_back({{"title", offer.title}, {"reason", found.error().cause}});
    } else if (const CheckReport report = check_program(*shape, found->program); !report.accepted()) {
      left.push_back({{"title", offer.title}, {"reason", report.findings.front().text}});
    } else {
      offers.push_back({{"title", offer.title},
                        {"edit", to_json(offer.edit)},
                        {"program", to_json(found->program)},
                        {"seconds", std::round(took.count() * 1000) / 1000}});
    }
  }
  return write_json(arguments, {{"offers", std::move(offers)}, {"left", std::move(left)}});
}

}  // namespace

extern const Command offers_command;
const Command offers_command = {"offers",
                                "MODEL.glb|SHAPE.json [-o OFFERS.json]",
                                "Sliders that a model's geometry and labels offer by themselves: width, counts, legs; "
                                "and what was left out, and why.",
                                {"-o"},
                                {},
                                run};

}  // namespace parsel::cli
