#include "core/prove/prove.h"

#include <algorithm>
#include <cmath>

#include "core/prove/deviation.h"
#include "core/prove/enclosure.h"
#include "core/prove/scope.h"

namespace parsel {

namespace {

constexpr double closed_ratio = 1e-2;  ///< a bound this near to a value that occurs is as good as the maximum
constexpr double closed_noise = 1e-6;  ///< … or this near, in the normalised frame
/// Wider than the 1e-9 that change_count forgives, so that a count and a floor() that jump as one are one jump.
constexpr double bracket_width = 1e-8;
constexpr int most_brackets = 4000;  ///< amounts looked at while bracketing jumps
constexpr int most_pieces = 96;      ///< pieces bounded, per layer
constexpr int coarse_samples = 5;    ///< the search itself looks at the middle of every piece
constexpr int dense_samples = 257;

/// Splits a range where an amount jumps or has a kink: the closed segments between the brackets.
std::vector<Interval> smooth_segments(const Enclosure& enclosure, double low, double high) {
  std::vector<Interval> segments;
  std::vector<Interval> waiting = {{low, high}};
  bool extends = false;  // the last segment ends where the next piece starts
  for (int looked = 0; !waiting.empty(); ++looked) {
    const Interval piece = waiting.back();
    waiting.pop_back();
    const bool smooth = enclosure.is_smooth(piece);
    const double middle = piece.low + (piece.high - piece.low) / 2;
    const bool divisible = piece.high - piece.low > bracket_width && looked < most_brackets;
    if (!smooth && divisible) {
      waiting.push_back({middle, piece.high});
      waiting.push_back({piece.low, middle});
      continue;
    }
    // A piece that was given up for want of budget stays, so that nothing but true brackets is left out.
    const bool bracket = !smooth && piece.high - piece.low <= bracket_width;
    if (!bracket) {
      if (extends) {
        segments.back().high = piece.high;
      } else {
        segments.push_back(piece);
      }
    }
    extends = !bracket;
  }
  return segments;
}

/// What is known of one relation's largest deviation.
struct Search {
  Constraint constraint;
  double lower = 0;  ///< it occurs
  double upper = 0;  ///< over the pieces that are done

  double good_enough() const { return lower * (1 + closed_ratio) + closed_noise; }
};

struct Piece {
  Interval range;
  std::vector<std::size_t> searches;  ///< relations whose bound is not good enough around here
};

/// An upper bound of the deviation over a piece; raises `lower` by what occurs in its middle.
double bound_piece(Search& search, const JetState& at_middle, const JetState& over, double radius,
                   std::vector<Jet>& middle_jets) {
  middle_jets.clear();
  for_each_deviation(search.constraint, at_middle, [&](const Jet& jet) {
    if (jet.defined) search.lower = std::max(search.lower, jet.c[0].mignitude());
    middle_jets.push_back(jet);
  });
  double worst = 0;
  std::size_t i = 0;
  for_each_deviation(search.constraint, over, [&](const Jet& jet) {
    // The number of instances may differ where a count jumps; such jets are not defined.
    const Jet& middle = i < middle_jets.size() ? middle_jets[i] : jet;
    worst = std::max(worst, bound(middle, jet, radius));
    ++i;
  });
  return worst;
}

/// Branch and bound over the segments, all relations together, so that a piece's state is made once.
void bound_all(const Enclosure& enclosure, const std::vector<Interval>& segments, std::vector<Search>& searches) {
  std::vector<Piece> waiting;
  std::vector<std::size_t> all(searches.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  for (const Interval& segment : segments) waiting.push_back({segment, all});
  std::vector<Jet> scratch;
  // Breadth first: the budget goes to every segment alike, and `lower` grows early.
  for (std::size_t next = 0; next < waiting.size(); ++next) {
    const Piece piece = std::move(waiting[next]);
    const double middle = piece.range.low + (piece.range.high - piece.range.low) / 2;
    const double radius = detail::up(std::max(piece.range.high - middle, middle - piece.range.low));
    const JetState at_middle = enclosure(Interval(middle));
    const JetState over = enclosure(piece.range);
    const bool divisible = waiting.size() + 2 <= most_pieces;
    std::vector<std::size_t> loose;
    for (const std::size_t i : piece.searches) {
      const double worst = bound_piece(searches[i], at_middle, over, radius, scratch);
      if (worst <= searches[i].good_enough() || !divisible) {
        searches[i].upper = std::max(searches[i].upper, worst);
      } else {
        loose.push_back(i);
      }
    }
    if (loose.empty()) continue;
    waiting.push_back({{piece.range.low, middle}, loose});
    waiting.push_back({{middle, piece.range.high}, loose});
  }
}

std::vector<double> sample_values(const std::vector<Interval>& segments, double low, double high, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(low + (high - low) * i / (count - 1));
  values.back() = high;
  for (const Interval& segment : segments) {
    values.push_back(segment.low);
    values.push_back(segment.high);
  }
  return values;
}

}  // namespace

std::vector<RelationReport> prove_relations(const Shape& shape, const Program& program, std::size_t layer,
                                            const std::set<std::string>& disabled) {
  const Scope scope = scope_of(shape, program, layer, disabled);
  if (scope.relations.empty()) return {};
  Program applied = program;
  applied.layers.resize(layer + 1);
  const Parameter& parameter = applied.layers[layer].parameter;
  const Enclosure enclosure(shape, applied, layer);
  const Evaluator evaluator(applied, shape);
  std::vector<double> values;
  for (const Layer& l : applied.layers) values.push_back(l.parameter.value);

  std::vector<Search> searches;
  values[layer] = 0;
  const State at_rest = evaluator(values);
  for (const RelationIndex r : scope.relations) {
    Constraint constraint = make_constraint(shape, r);
    if (exists(constraint, at_rest)) searches.push_back({std::move(constraint)});
  }
  const auto sample = [&](const std::vector<double>& xs, const std::vector<std::size_t>& wanted) {
    for (const double x : xs) {
      values[layer] = x;
      const State state = evaluator(values);
      for (const std::size_t i : wanted) {
        searches[i].lower = std::max(searches[i].lower, deviation(searches[i].constraint, state));
      }
    }
  };
  const std::vector<Interval> segments = smooth_segments(enclosure, parameter.min, parameter.max);
  std::vector<std::size_t> open(searches.size());
  for (std::size_t i = 0; i < open.size(); ++i) open[i] = i;
  sample(sample_values(segments, parameter.min, parameter.max, coarse_samples), open);
  bound_all(enclosure, segments, searches);

  const auto is_certified = [&](const Search& search) {
    const double tolerance = tolerance_of(*search.constraint.relation, scope);
    // A proven bound below a value that occurs would be a contradiction: never call that a proof.
    const bool consistent = search.upper + closed_noise >= search.lower;
    return consistent && (search.upper <= search.good_enough() || search.upper <= tolerance);
  };
  open.clear();
  std::vector<bool> certified_ones;
  for (std::size_t i = 0; i < searches.size(); ++i) {
    certified_ones.push_back(is_certified(searches[i]));
    if (!certified_ones[i]) open.push_back(i);
  }
  if (!open.empty()) sample(sample_values(segments, parameter.min, parameter.max, dense_samples), open);

  std::vector<RelationReport> reports;
  for (std::size_t i = 0; i < searches.size(); ++i) {
    const Search& search = searches[i];
    const Relation& relation = *search.constraint.relation;
    const bool certified = certified_ones[i];
    RelationReport report;
    report.id = relation.id;
    report.proof = certified ? Proof::certified : Proof::sampled;
    report.worst = certified ? std::max(search.upper, search.lower) : search.lower;
    const bool held = report.worst <= tolerance_of(relation, scope);
    report.status = is_disabled(relation, disabled) ? RelationStatus::disabled
                    : held                          ? RelationStatus::held
                                                    : RelationStatus::broken;
    reports.push_back(std::move(report));
  }
  return reports;
}

}  // namespace parsel
