// Mirror images about planes x, y or z = constant, pair by pair.
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "core/shape/symmetry_search.h"

namespace parsel {
namespace {

/// Parts of one kind and one axis.
class ReflectionSearch {
 public:
  ReflectionSearch(SymmetrySearch& search, const Parts& kind, int axis)
      : search_(search), options_(search.options), axis_(axis) {
    make_lines(kind);
  }

  void find() {
    take_near_middle();
    take_own_planes();
    drop_half_paired_groups();
    std::stable_sort(pairs_.begin(), pairs_.end(), [](const MirrorPair& m, const MirrorPair& n) {
      return std::pair(m.a, m.b) < std::pair(n.a, n.b);
    });
    search_.found.mirrors.insert(search_.found.mirrors.end(), pairs_.begin(), pairs_.end());
  }

 private:
  /// Parts that follow each other along the axis, of one size: a part's twins are among those of its line.
  struct Line {
    Parts parts;
    double middle = 0;  ///< of the outermost centres
    bool taken = false;
  };

  double at(PartIndex p) const { return search_.centre(p)[axis_]; }

  /// What is cheap to tell, without the surfaces.
  bool may_pair(PartIndex a, PartIndex b) const {
    Vec3 across = search_.centre(a) - search_.centre(b);
    if (std::abs(across[axis_]) <= options_.apart) return false;
    across[axis_] = 0;
    const bool one_group = !search_.is_free(a) && search_.group_of(a) == search_.group_of(b);
    return across.norm() <= options_.image && !one_group && search_.same_extents(a, b);
  }

  void make_lines(const Parts& kind) {
    std::vector<std::size_t> line(kind.size());
    std::iota(line.begin(), line.end(), std::size_t{0});
    for (std::size_t i = 0; i < kind.size(); ++i) {
      for (std::size_t j = i + 1; j < kind.size(); ++j) {
        if (line[i] != line[j] && may_pair(kind[i], kind[j])) std::replace(line.begin(), line.end(), line[j], line[i]);
      }
    }
    std::map<std::size_t, Line> lines;
    for (std::size_t i = 0; i < kind.size(); ++i) lines[line[i]].parts.push_back(kind[i]);
    for (auto& [number, made] : lines) {
      if (made.parts.size() < 2) continue;
      const auto [low, high] = std::minmax_element(made.parts.begin(), made.parts.end(),
                                                   [&](PartIndex a, PartIndex b) { return at(a) < at(b); });
      made.middle = (at(*low) + at(*high)) / 2;
      lines_.push_back(std::move(made));
    }
  }

  /// The pairs of a line about a plane, the nearest to its image first; `rest`: parts off the plane without a twin.
  std::vector<MirrorPair> pairs_about(const Line& line, double offset, std::size_t* rest = nullptr) {
    std::vector<std::pair<double, MirrorPair>> possible;
    for (std::size_t i = 0; i < line.parts.size(); ++i) {
      for (std::size_t j = i + 1; j < line.parts.size(); ++j) {
        const PartIndex a = line.parts[i], b = line.parts[j];
        const double off = std::abs((at(a) + at(b)) / 2 - offset);
        if (off <= options_.plane && may_pair(a, b)) {
          possible.push_back({off, {std::min(a, b), std::max(a, b), axis_, offset}});
        }
      }
    }
    std::stable_sort(possible.begin(), possible.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
    std::vector<MirrorPair> pairs;
    Parts done;
    const auto is_done = [&](PartIndex p) { return std::find(done.begin(), done.end(), p) != done.end(); };
    for (const auto& [off, pair] : possible) {
      if (is_done(pair.a) || is_done(pair.b) || !search_.mirrors(pair.a, pair.b, axis_, offset)) continue;
      pairs.push_back(pair);
      done.insert(done.end(), {pair.a, pair.b});
    }
    if (rest != nullptr) {
      *rest = static_cast<std::size_t>(std::count_if(line.parts.begin(), line.parts.end(), [&](PartIndex p) {
        return !is_done(p) && std::abs(at(p) - offset) > options_.apart / 2;
      }));
    }
    return pairs;
  }

  /// The shape's middle plane; or, where the lines near it agree on one beside it and more of them pair about that, it.
  void take_near_middle() {
    using ByLine = std::vector<std::vector<MirrorPair>>;
    const auto about = [&](double offset) {
      ByLine by_line;
      for (const Line& line : lines_) by_line.push_back(pairs_about(line, offset));
      return by_line;
    };
    const auto count = [](const ByLine& by_line) {
      return std::accumulate(by_line.begin(), by_line.end(), std::size_t{0},
                             [](std::size_t sum, const auto& pairs) { return sum + pairs.size(); });
    };
    ByLine best = about(0);
    double sum = 0;
    std::size_t near = 0, missed = 0;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (std::abs(lines_[i].middle) > 2 * options_.plane) continue;
      sum += lines_[i].middle;
      ++near;
      if (best[i].empty()) ++missed;
    }
    if (missed > 0) {
      ByLine beside = about(sum / static_cast<double>(near));
      if (count(beside) > count(best)) best = std::move(beside);
    }
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      lines_[i].taken = !best[i].empty();
      pairs_.insert(pairs_.end(), best[i].begin(), best[i].end());
    }
  }

  /// What the middle left over: a line's own middle, when every part of the line has its twin about it. Of boards at
  /// unequal heights any two are images of each other; only all of them together are meant. Lines whose middles agree
  /// share one plane, so that four legs are two pairs each way about two planes.
  void take_own_planes() {
    std::vector<Line*> open;
    for (Line& line : lines_) {
      std::size_t rest = 0;
      if (!line.taken && !pairs_about(line, line.middle, &rest).empty() && rest == 0) open.push_back(&line);
    }
    std::stable_sort(open.begin(), open.end(), [](const Line* a, const Line* b) { return a->middle < b->middle; });
    for (std::size_t from = 0, to = 0; from < open.size(); from = to) {
      while (to < open.size() && open[to]->middle - open[from]->middle <= options_.plane) ++to;
      const double shared = (open[from]->middle + open[to - 1]->middle) / 2;
      for (std::size_t i = from; i < to; ++i) {
        const std::vector<MirrorPair> pairs = pairs_about(*open[i], shared);
        pairs_.insert(pairs_.end(), pairs.begin(), pairs.end());
      }
    }
  }

  /// Two groups are images of each other only when all their instances are, about one plane.
  void drop_half_paired_groups() {
    const auto key = [&](const MirrorPair& m) {
      return std::pair(std::minmax({search_.group_of(m.a), search_.group_of(m.b)}), m.offset);
    };
    const auto is_mixed = [&](const MirrorPair& m) { return search_.is_free(m.a) || search_.is_free(m.b); };
    std::map<std::pair<std::pair<std::size_t, std::size_t>, double>, std::size_t> count;
    for (const MirrorPair& m : pairs_) ++count[key(m)];
    std::erase_if(pairs_, [&](const MirrorPair& m) {
      if (is_mixed(m)) return false;
      const std::size_t paired = count[key(m)];
      return paired != search_.found.groups[search_.group_of(m.a)].parts.size() ||
             paired != search_.found.groups[search_.group_of(m.b)].parts.size();
    });
  }

  SymmetrySearch& search_;
  const SymmetryOptions& options_;
  const int axis_;
  std::vector<Line> lines_;
  std::vector<MirrorPair> pairs_;
};

}  // namespace

void SymmetrySearch::find_reflections(const Parts& kind) {
  for (int axis = 0; axis < 3; ++axis) ReflectionSearch(*this, kind, axis).find();
}

}  // namespace parsel
