#include "core/family/agreement.h"

#include <algorithm>

namespace parsel::family {

std::string_view to_string(Agreement agreement) {
  constexpr std::string_view words[] = {"common", "near", "accidental"};
  return words[static_cast<std::size_t>(agreement)];
}

std::vector<Evidence> find_agreement(const std::vector<Constraint>& constraints,
                                     const std::vector<Variation>& variations, double tolerance,
                                     const Choices& choices) {
  std::vector<Evidence> found;
  for (const Constraint& constraint : constraints) {
    Evidence evidence;
    for (std::size_t v = 0; v < variations.size(); ++v) {
      if (!variations[v].has(constraint.a.part) || !variations[v].has(constraint.b.part)) continue;
      ++evidence.seen;
      if (constraint.residual(variations[v].values) > tolerance) evidence.broken_by.push_back(v);
    }
    if (evidence.broken_by.empty()) {
      evidence.agreement = Agreement::common;
    } else if (evidence.broken_by.size() == 1 && evidence.seen > 2) {
      evidence.agreement = Agreement::near;
    }
    evidence.is_kept = evidence.agreement == Agreement::common;
    if (const auto choice = choices.find(constraint.id()); choice != choices.end()) {
      evidence.is_kept = choice->second == Choice::forced;
    }
    found.push_back(std::move(evidence));
  }
  return found;
}

std::vector<std::size_t> independent(const std::vector<Constraint>& constraints, const std::vector<Evidence>& evidence,
                                     std::size_t parameters) {
  Elimination elimination(parameters);
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    if (!evidence[i].is_kept) continue;
    bool raises = false;
    for (const SparseRow& row : constraints[i].rows()) raises |= elimination.add(row);
    if (raises) chosen.push_back(i);
  }
  return chosen;
}

std::vector<OptionalGroup> optional_groups(const std::vector<Variation>& variations, std::size_t parts) {
  std::vector<OptionalGroup> groups;
  for (std::size_t p = 0; p < parts; ++p) {
    std::vector<std::size_t> absent_from;
    for (std::size_t v = 0; v < variations.size(); ++v) {
      if (!variations[v].has(p)) absent_from.push_back(v);
    }
    if (absent_from.empty()) continue;
    const auto same = std::find_if(groups.begin(), groups.end(),
                                   [&](const OptionalGroup& group) { return group.absent_from == absent_from; });
    if (same == groups.end()) {
      groups.push_back({{p}, std::move(absent_from)});
    } else {
      same->parts.push_back(p);
    }
  }
  return groups;
}

}  // namespace parsel::family
