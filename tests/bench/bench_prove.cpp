// Time of prove_relations() and find_range() on programs of 20 parts and 30 attachments, by the form of the amounts.
// Processor time, so that a busy machine does not disturb it. Prints CSV lines `benchmark,case,metric,value`.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <vector>

#include "core/prove/prove.h"
#include "core/prove/range.h"

using namespace parsel;

namespace {

constexpr int parts = 20;
constexpr int relations = 30;

/// A row of boxes; each touches the next (line), every other one the next but one (face).
Shape row() {
  Shape shape;
  shape.name = "row";
  for (int i = 0; i < parts; ++i) {
    Part part;
    part.id = part.label = part.name = "part_" + std::to_string(i);
    part.node = i;
    part.primitive = 0;
    part.hexahedron = make_box({-0.9 + 0.09 * i, 0.01 * i, 0}, Mat3::Identity(), {0.05, 0.1, 0.1});
    shape.parts.push_back(std::move(part));
  }
  const auto attach = [&](int a, int b, const std::vector<Vec3>& points) {
    Attachment attachment{points, {}, {}};
    for (const Vec3& p : points) {
      attachment.local_a.push_back(shape.parts[PartIndex(static_cast<std::size_t>(a))].hexahedron.local(p));
      attachment.local_b.push_back(shape.parts[PartIndex(static_cast<std::size_t>(b))].hexahedron.local(p));
    }
    const RelationKind kind = points.size() == 2 ? RelationKind::line : RelationKind::face;
    const std::vector<PartIndex> both = {PartIndex(static_cast<std::size_t>(a)),
                                         PartIndex(static_cast<std::size_t>(b))};
    shape.relations.push_back({"a" + std::to_string(shape.relations.size() + 1), kind, both, attachment});
  };
  for (int i = 0; i + 1 < parts; ++i) {
    const double x = -0.855 + 0.09 * i;
    attach(i, i + 1, {{x, 0, -0.1}, {x, 0, 0.1}});
  }
  for (int i = 0; static_cast<int>(shape.relations.size()) < relations; i += 1) {
    const double x = -0.81 + 0.09 * i;
    attach(i, i + 2, {{x, -0.1, -0.1}, {x, -0.1, 0.1}, {x, 0.1, -0.1}, {x, 0.1, 0.1}});
  }
  return shape;
}

Program program(const Shape& shape, Op op, const std::string& amount, const std::string& odd_amount) {
  Program result;
  Layer layer;
  layer.parameter = {"x1", -0.35, 0.35, 0};
  for (const Part& part : shape.parts) {
    Statement s;
    s.op = op;
    s.part = part.id;
    s.origin = Vec3(0, 0, 0);
    s.direction = op == Op::rotate ? Vec3::UnitY() : Vec3::UnitX();
    const bool odd = part.node % 2 == 1;
    s.amount = parse_amount(odd ? odd_amount : amount).value();
    layer.statements.push_back(std::move(s));
  }
  result.layers.push_back(std::move(layer));
  return result;
}

template <class F>
double median_ms(F f) {
  std::vector<double> times;
  for (int i = 0; i < 21; ++i) {
    const std::clock_t start = std::clock();
    f();
    times.push_back(1000.0 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  std::nth_element(times.begin(), times.begin() + 10, times.end());
  return times[10];
}

void run(const Shape& shape, const char* name, const Program& p) {
  std::vector<RelationReport> reports;
  const double prove = median_ms([&] { reports = prove_relations(shape, p, 0, {}); });
  const double range = median_ms([&] { find_range(shape, p, 0, -0.35, 0.35); });
  const auto certified = std::count_if(reports.begin(), reports.end(),
                                       [](const RelationReport& r) { return r.proof == Proof::certified; });
  const auto held = std::count_if(reports.begin(), reports.end(),
                                  [](const RelationReport& r) { return r.status == RelationStatus::held; });
  double largest = 0;
  for (const RelationReport& r : reports) {
    if (r.status == RelationStatus::held) largest = std::max(largest, r.worst);
  }
  std::printf("bench_prove,%s,prove_ms,%.3f\n", name, prove);
  std::printf("bench_prove,%s,range_ms,%.3f\n", name, range);
  std::printf("bench_prove,%s,relations,%zu\n", name, reports.size());
  std::printf("bench_prove,%s,certified,%td\n", name, certified);
  std::printf("bench_prove,%s,held,%td\n", name, held);
  std::printf("bench_prove,%s,largest_held_bound,%.2g\n", name, largest);
}

}  // namespace

int main() {
  const Shape shape = row();
  std::printf("benchmark,case,metric,value\n");
  run(shape, "scale_held", program(shape, Op::scale_1d, "x1", "x1"));
  run(shape, "scale_broken", program(shape, Op::scale_1d, "x1", "0.5*x1"));
  run(shape, "rotate_held", program(shape, Op::rotate, "x1", "x1"));
  run(shape, "rotate_broken", program(shape, Op::rotate, "x1", "0.5*x1"));
  run(shape, "chain_held", program(shape, Op::rotate, "atan2(sin(x1),1.2-cos(x1))", "atan2(sin(x1),1.2-cos(x1))"));
  run(shape, "floor_broken", program(shape, Op::scale_1d, "floor(10*x1)/10", "x1"));
  return 0;
}
