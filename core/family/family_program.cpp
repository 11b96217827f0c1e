#include "core/family/family_program.h"

#include <algorithm>

namespace parsel::family {

namespace {

/// A coefficient of a slider: exact as long as it is a fraction.
struct Coefficient {
  Rational exact;
  double rest = 0;

  bool is_zero() const { return exact.is_zero() && rest == 0; }
  Amount times(const std::string& parameter) const {
    const GiNaC::ex symbol = Amount::parameter(parameter).expression();
    const GiNaC::numeric fraction =
        GiNaC::numeric(static_cast<long>(exact.numerator())) / GiNaC::numeric(static_cast<long>(exact.denominator()));
    if (rest == 0) return Amount(fraction * symbol);
    return Amount(Amount::constant(exact.value() + rest).expression() * symbol);
  }
};

class Compiler {
 public:
  explicit Compiler(const Family& family) : family_(family) {
    int node = 0;
    for (const cad::Part& part : family.model.parts) nodes_.push_back(part.role == cad::Role::add ? node++ : -1);
  }

  std::vector<Statement> statements(std::size_t slider, const std::string& parameter) {
    slider_ = slider;
    parameter_ = parameter;
    made_.clear();
    for (std::size_t p = 0; p < family_.model.parts.size(); ++p) {
      if (nodes_[p] >= 0) part(p);
    }
    return std::move(made_);
  }

 private:
  Rational coefficient(std::size_t i) const { return family_.basis.coefficients[i][slider_]; }

  void move(std::size_t p, const LocalTriple& feature, int axis, const Coefficient& by) {
    if (by.is_zero()) return;
    Statement statement;
    statement.op = Op::translate;
    statement.part = "node:" + std::to_string(nodes_[p]);
    statement.feature = feature;
    statement.direction = Vec3(Vec3::Unit(axis));
    statement.amount = by.times(parameter_);
    made_.push_back(std::move(statement));
  }

  void part(std::size_t p) {
    const cad::Part& given = family_.model.parts[p];
    const bool has_top =
        given.kind == cad::Kind::cone && family_.options.vocabulary == Vocabulary::extended && given.top > 0;
    const cad::Extent box = cad::extent(given);
    for (int axis = 0; axis < 3; ++axis) {
      const Rational centre = coefficient(family_.layout.centre(p, axis)),
                     size = coefficient(family_.layout.extent(p, axis));
      if (has_top && axis != given.axis) {
        top_edges(p, axis, centre, size);
        continue;
      }
      const double low = box.low[axis] / given.size[axis], high = box.high[axis] / given.size[axis];
      const auto face = [&](double share) {
        const Rational half(share < 0 ? -1 : 1, 2);
        if (std::abs(share - half.value()) < 1e-12) return Coefficient{centre + half * size, 0};
        return Coefficient{centre, share * size.value()};
      };
      const Coefficient down = face(low), up = face(high);
      if (down.exact == up.exact && down.rest == up.rest) {
        move(p, {0, 0, 0}, axis, down);
        continue;
      }
      LocalTriple feature{0, 0, 0};
      feature[static_cast<std::size_t>(axis)] = -1;
      move(p, feature, axis, down);
      feature[static_cast<std::size_t>(axis)] = 1;
      move(p, feature, axis, up);
    }
  }

  /// The box of a cone is as wide as its wider end; what changes one end by a share moves the box's edges there by it.
  void top_edges(std::size_t p, int axis, const Rational& centre, const Rational& size) {
    const cad::Part& given = family_.model.parts[p];
    const double half = cad::extent(given).high[axis];
    const double base_share = size.value() / given.size[axis];
    const double top_share = coefficient(family_.layout.top(p)).value() / given.top;
    for (const int end : {-1, 1}) {
      const double share = end == given.towards ? top_share : base_share;
      for (const int side : {-1, 1}) {
        LocalTriple feature{0, 0, 0};
        feature[static_cast<std::size_t>(given.axis)] = end;
        feature[static_cast<std::size_t>(axis)] = side;
        move(p, feature, axis, {centre, side * half * share});
      }
    }
  }

  const Family& family_;
  std::vector<int> nodes_;
  std::vector<Statement> made_;
  std::size_t slider_ = 0;
  std::string parameter_;
};

}  // namespace

Frame drawn_frame(const cad::Model& model) {
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const cad::Part& part : model.parts) {
    if (part.role != cad::Role::add) continue;
    const cad::Extent box = cad::extent(part);
    low = low.cwiseMin(part.centre + box.low);
    high = high.cwiseMax(part.centre + box.high);
  }
  return {(low + high) / 2, (high - low).norm() / 2};
}

Result<Program> family_program(const Family& family, const std::string& shape_name, const std::string& shape_sha256) {
  Program program;
  program.shape_name = shape_name;
  program.shape_sha256 = shape_sha256;
  const double scale = drawn_frame(family.model).scale;
  Compiler compiler(family);
  std::size_t count = 0;
  for (std::size_t k = 0; k < family.sliders.size(); ++k) {
    const Slider& slider = family.sliders[k];
    Layer layer;
    layer.request = slider.name;
    const Interval range = reach(family, k);
    layer.parameter = {"x" + std::to_string(k + 1), (range.low - slider.value) / scale,
                       (range.high - slider.value) / scale, 0};
    layer.statements = compiler.statements(k, layer.parameter.name);
    count += layer.statements.size();
    program.layers.push_back(std::move(layer));
  }
  if (program.layers.size() > ProgramLimits::layers || count > ProgramLimits::statements) {
    return Error{"family/program", "", "the family has more sliders or moves more faces than a program may hold",
                 "keep more constraints, or take a model with fewer parts"};
  }
  return program;
}

std::vector<double> program_values(const Family& family, const Eigen::VectorXd& setting) {
  const Eigen::VectorXd values = (setting - family.base_setting) / drawn_frame(family.model).scale;
  return {values.data(), values.data() + values.size()};
}

}  // namespace parsel::family
