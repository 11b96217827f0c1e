// How long one slider step takes natively: 100 parts in two groups and on their own, 200 statements in two layers.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>

#include "core/edit/evaluate.h"

using namespace parsel;

namespace {

Part box_part(const std::string& id, const Vec3& centre, const Vec3& half) {
  Part part;
  part.id = part.label = part.name = id;
  part.hexahedron = make_box(centre, Mat3::Identity(), half);
  return part;
}

/// 89 single parts, a line of 10 slats and its virtual parent.
Shape bench_shape() {
  Shape shape;
  for (int i = 0; i < 89; ++i) {
    shape.parts.push_back(box_part("part_" + std::to_string(i), Vec3(0.01 * i - 0.5, 0.3, 0), Vec3(0.05, 0.1, 0.1)));
  }
  Relation line;
  line.id = "t1";
  line.kind = RelationKind::translation;
  for (int i = 0; i < 10; ++i) {
    line.parts.push_back(shape.parts.push_back(
        box_part("slat_" + std::to_string(i), Vec3(0.1 * i - 0.45, -0.3, 0), Vec3(0.02, 0.2, 0.02))));
  }
  Part parent = box_part("slats", Vec3(0, -0.3, 0), Vec3(0.47, 0.2, 0.02));
  parent.members = line.parts;
  const PartIndex p = shape.parts.push_back(parent);
  line.detail = Translation{p, Vec3(-0.45, -0.3, 0), Vec3(0.45, -0.3, 0), 0, 1};
  shape.relations.push_back(line);
  return shape;
}

Program bench_program() {
  // P is the part, X the parameter.
  const char* kinds[] = {"translate(P, amount=0.5*X, direction=(1, 0, 0))",
                         "scale_1d(P, amount=X/3, origin=point(P, -1, 0, 0), direction=axis(P, 0))",
                         "rotate(P, amount=2*atan2(X, 1 + sqrt(1 - X^2)), origin=(0, 0, 0), axis=(0, 1, 0))",
                         "scale_2d(P, amount=X^2, origin=point(P, 0, 1, 0), normal=axis(P, 1), feature=(0, 1, 0))"};
  std::string text = "parsel program 1\nshape \"bench\" \"\"\n";
  for (const std::string x : {"x1", "x2"}) {
    text += "layer \"\": " + x + " = 0 in [-0.35, 0.35]\n";
    for (int i = 0; i < 98; ++i) {
      for (const char* c = kinds[i % 4]; *c != '\0'; ++c) {
        if (*c == 'P') {
          text += "\"part_" + std::to_string(i % 89) + "\"";
        } else if (*c == 'X') {
          text += x;
        } else {
          text += *c;
        }
      }
      text += "\n";
    }
    text += "scale_1d(\"slats\", amount=" + x + ", origin=(0, 0, 0), direction=(1, 0, 0), feature=(0, 1, 0))\n";
    text += "change_count(\"t1\", amount=floor(10*" + x + "), anchor=fit)\n";
  }
  Result<Program> program = program_from_text(text);
  PARSEL_ASSERT(program.ok(), program.ok() ? "" : program.error().message().c_str());
  return *program;
}

}  // namespace

int main() {
  const Shape shape = bench_shape();
  const Program program = bench_program();
  const Status valid = validate(program, shape);
  PARSEL_ASSERT(valid.ok(), valid.ok() ? "" : valid.error().message().c_str());
  using Clock = std::chrono::steady_clock;
  const auto microseconds = [](Clock::duration d) { return std::chrono::duration<double, std::micro>(d).count(); };

  const Clock::time_point start = Clock::now();
  const Evaluator evaluate(program, shape);
  const double compile = microseconds(Clock::now() - start);

  std::vector<double> steps;
  double sum = 0;
  for (int i = 0; i < 2000; ++i) {
    const double x = 0.35 * (i % 200 - 100) / 100;
    const Clock::time_point before = Clock::now();
    const State state = evaluate({x, -x});
    steps.push_back(microseconds(Clock::now() - before));
    sum += state.parts[PartIndex(0)](0, 0);
  }
  std::sort(steps.begin(), steps.end());
  std::printf("benchmark,case,metric,value\n");
  std::printf("evaluate,100 parts 200 statements,compile_us,%.1f\n", compile);
  std::printf("evaluate,100 parts 200 statements,median_us,%.1f\n", steps[steps.size() / 2]);
  std::printf("evaluate,100 parts 200 statements,p99_us,%.1f\n", steps[steps.size() * 99 / 100]);
  std::printf("evaluate,100 parts 200 statements,checksum,%.6f\n", sum);
  return 0;
}
