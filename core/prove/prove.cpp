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
/// Jumps are bracketed to this: narrow enough that what is continuous changes by less than closed_noise in a bracket,
/// wide enough that a jump costs few halvings.
constexpr double bracket_width = 1e-8;
constexpr int most_brackets = 4000;      ///< amounts looked at while bracketing jumps
constexpr std::size_t most_cases = 8;    ///< of a bracket: three questions of two answers
constexpr std::size_t most_pieces = 96;  ///< bounded beyond those between and around jumps, per layer
constexpr int coarse_samples = 5;        ///< the search itself looks at the middle of every piece
constexpr int dense_samples = 257;

struct Segment {
  Interval range;
  bool bracket = false;  ///< an amount jumps or has a kink in it, as far as can be seen
};

/// Splits a range where an amount jumps or has a kink: brackets and what lies between them, side by side, no gap.
std::vector<Segment> smooth_segments(const Enclosure& enclosure, double low, double high) {
  std::vector<Segment> segments;
  std::vector<Interval> waiting = {{low, high}};
  for (int looked = 0; !waiting.empty(); ++looked) {
    const Interval piece = waiting.back();
    waiting.pop_back();
    const bool smooth = enclosure.is_smooth(piece);
    const double middle = piece.low + (piece.high - piece.low) / 2;
    const bool divisible = piece.high - piece.low > bracket_width && looked < most_brackets;
    if (!smooth && divisible) {
      waiting.push_back({middle, piece.high});
      waiting.push_back({piece.low, middle});
    } else if (smooth && !segments.empty() && !segments.back().bracket) {
      segments.back().range.high = piece.high;
    } else {
      segments.push_back({piece, !smooth});
    }
  }
  return segments;
}

/// What is known of one relation's largest deviation.
struct Search {
  Constraint constraint;
  double lower = 0;  ///< it occurs
  double upper = 0;  ///< over the pieces that are done
  double tolerance = 0;
  std::vector<double> loose;  ///< middles of pieces whose bound stayed loose

  /// Whether a bound says enough: near to what occurs, and on the same side of the tolerance.
  bool is_good(double bound) const {
    return bound <= lower * (1 + closed_ratio) + closed_noise && (bound <= tolerance || lower > tolerance);
  }
};

struct Piece {
  Interval range;
  bool bracket;
  std::vector<std::size_t> searches;  ///< relations whose bound is not good enough around here
};

/// An upper bound of the deviation over a piece from the states in its middle and over it; raises `lower` by what
/// occurs in the middle, unless the state there is that of a case, which need not occur.
double bound_piece(Search& search, const JetState& at_middle, const JetState& over, double radius, bool occurs,
                   std::vector<Jet>& middle_jets) {
  middle_jets.clear();
  for_each_deviation(search.constraint, at_middle, [&](const Jet& jet) {
    if (occurs && jet.defined) search.lower = std::max(search.lower, jet.c[0].mignitude());
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
void bound_all(const Enclosure& enclosure, const std::vector<Segment>& segments, std::vector<Search>& searches) {
  std::vector<Piece> waiting;
  std::vector<std::size_t> all(searches.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  for (const Segment& segment : segments) waiting.push_back({segment.range, segment.bracket, all});
  const std::size_t most = segments.size() + most_pieces;
  std::vector<Jet> scratch;
  std::vector<double> worst(searches.size());
  // Breadth first: the budget goes to every segment alike, and `lower` grows early.
  for (std::size_t next = 0; next < waiting.size(); ++next) {
    const Piece piece = std::move(waiting[next]);
    const double middle = piece.range.low + (piece.range.high - piece.range.low) / 2;
    const double radius = detail::up(std::max(piece.range.high - middle, middle - piece.range.low));
    std::vector<std::vector<Case>> cases;
    if (piece.bracket) cases = enclosure.cases_over(piece.range, most_cases);
    if (cases.empty()) cases.emplace_back();
    for (const std::size_t i : piece.searches) worst[i] = 0;
    for (const std::vector<Case>& given : cases) {
      const JetState at_middle = enclosure(Interval(middle), given);
      const JetState over = enclosure(piece.range, given);
      for (const std::size_t i : piece.searches) {
        worst[i] = std::max(worst[i], bound_piece(searches[i], at_middle, over, radius, given.empty(), scratch));
      }
    }
    const bool divisible = waiting.size() + 2 <= most && piece.range.low < middle && middle < piece.range.high;
    std::vector<std::size_t> loose;
    for (const std::size_t i : piece.searches) {
      const bool good = searches[i].is_good(worst[i]);
      if (!good && divisible) {
        loose.push_back(i);
        continue;
      }
      searches[i].upper = std::max(searches[i].upper, worst[i]);
      if (!good) searches[i].loose.push_back(middle);
    }
    if (loose.empty()) continue;
    waiting.push_back({{piece.range.low, middle}, piece.bracket, loose});
    waiting.push_back({{middle, piece.range.high}, piece.bracket, loose});
  }
}

std::vector<double> sample_values(const std::vector<Segment>& segments, double low, double high, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(low + (high - low) * i / (count - 1));
  values.back() = high;
  for (std::size_t s = 1; s < segments.size(); ++s) values.push_back(segments[s].range.low);
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
    const double tolerance = tolerance_of(shape.relations[r], scope);
    if (exists(constraint, at_rest)) searches.push_back({std::move(constraint), 0, 0, tolerance, {}});
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
  const std::vector<Segment> segments = smooth_segments(enclosure, parameter.min, parameter.max);
  std::vector<std::size_t> open(searches.size());
  for (std::size_t i = 0; i < open.size(); ++i) open[i] = i;
  sample(sample_values(segments, parameter.min, parameter.max, coarse_samples), open);
  bound_all(enclosure, segments, searches);

  const auto is_certified = [](const Search& search) {
    // A proven bound below a value that occurs would be a contradiction: never call that a proof.
    const bool consistent = search.upper + closed_noise >= search.lower;
    const bool held = std::max(search.upper, search.lower) <= search.tolerance;
    return consistent && (held || search.is_good(search.upper));
  };
  open.clear();
  std::vector<double> dense = sample_values(segments, parameter.min, parameter.max, dense_samples);
  std::vector<bool> certified_ones;
  for (std::size_t i = 0; i < searches.size(); ++i) {
    certified_ones.push_back(is_certified(searches[i]));
    if (certified_ones[i]) continue;
    open.push_back(i);
    dense.insert(dense.end(), searches[i].loose.begin(), searches[i].loose.end());
  }
  std::sort(dense.begin(), dense.end());
  dense.erase(std::unique(dense.begin(), dense.end()), dense.end());
  if (!open.empty()) sample(dense, open);

  std::vector<RelationReport> reports;
  for (std::size_t i = 0; i < searches.size(); ++i) {
    const Search& search = searches[i];
    const Relation& relation = *search.constraint.relation;
    const bool certified = certified_ones[i];
    RelationReport report;
    report.id = relation.id;
    report.proof = certified ? Proof::certified : Proof::sampled;
    report.worst = certified ? std::max(search.upper, search.lower) : search.lower;
    if (!certified) report.samples = static_cast<int>(dense.size());
    const bool held = report.worst <= search.tolerance;
    report.status = is_disabled(relation, disabled) ? RelationStatus::disabled
                    : held                          ? RelationStatus::held
                                                    : RelationStatus::broken;
    reports.push_back(std::move(report));
  }
  return reports;
}

}  // namespace parsel
