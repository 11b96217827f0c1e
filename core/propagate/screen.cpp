#include "core/propagate/screen.h"

#include <algorithm>
#include <cmath>

#include "core/base/tolerance.h"

namespace parsel {

namespace {

/// Fields or levers shorter than this cannot carry an amount: a motion of `exact` would take an amount above 5.
constexpr double shortest_field = 1e-4;

bool usable(const Samples& amount) {
  double largest = 0;
  for (const double value : amount) {
    if (!(std::abs(value) < largest_amount)) return false;
    largest = std::max(largest, std::abs(value));
  }
  return largest > noise;
}

std::optional<Fit> fit_linear(const Candidate& candidate, const Rows& rows, double tolerance) {
  constexpr std::size_t capacity = 64;
  std::array<Vec3, capacity> few;
  std::vector<Vec3> many;
  if (rows.size() > capacity) many.resize(rows.size());
  Vec3* v = rows.size() > capacity ? many.data() : few.data();
  double square = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    v[i] = rows.masked(i, rows.at(i, candidate.field));
    square += v[i].squaredNorm();
  }
  if (square < shortest_field * shortest_field) return std::nullopt;
  Fit result;
  // From the ends inwards: most candidates fail at the first sample.
  for (const std::size_t s : {7u, 0u, 6u, 1u, 5u, 2u, 4u, 3u}) {
    double dot = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) dot += v[i].dot(rows.goal(i, s));
    const double amount = dot / square;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double miss = (amount * v[i] - rows.goal(i, s)).cwiseAbs().maxCoeff();
      if (!(miss <= tolerance)) return std::nullopt;
      result.error = std::max(result.error, miss);
    }
    result.amount[s] = amount;
  }
  if (!usable(result.amount)) return std::nullopt;
  return result;
}

std::optional<Fit> fit_rotation(const Candidate& candidate, const Rows& rows, double tolerance) {
  const Vec3& axis = candidate.what.direction;
  Vec3 lever = Vec3::Zero();
  std::size_t longest = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows.is_free(i)) continue;
    const Vec3 v = rows.at(i, candidate.field);
    const Vec3 across = v - axis.dot(v) * axis;
    if (across.norm() <= lever.norm() * (1 + 1e-9)) continue;
    lever = across;
    longest = i;
  }
  if (lever.norm() < shortest_field) return std::nullopt;
  Fit result;
  const auto angle_at = [&](std::size_t s) {
    const Vec3 goal = lever + rows.goal(longest, s);
    const Vec3 turned_quarter = turned(lever, axis, pi / 2) + lever;  // axis × lever
    return std::atan2(turned_quarter.dot(goal), lever.dot(goal));
  };
  // Outwards from 0 on both sides, so that the angle does not jump where atan2 does.
  const auto unwrap = [&](std::size_t s, double previous) {
    const double angle = angle_at(s);
    result.amount[s] = angle - 2 * pi * std::round((angle - previous) / (2 * pi));
    return result.amount[s];
  };
  double up = 0;
  double down = 0;
  for (std::size_t i = 0; i < sample_count / 2; ++i) {
    up = unwrap(sample_count / 2 + i, up);
    down = unwrap(sample_count / 2 - 1 - i, down);
  }
  for (std::size_t s = 0; s < sample_count; ++s) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Vec3 moved = rows.masked(i, turned(rows.at(i, candidate.field), axis, result.amount[s]));
      const double miss = (moved - rows.goal(i, s)).cwiseAbs().maxCoeff();
      if (!(miss <= tolerance)) return std::nullopt;
      result.error = std::max(result.error, miss);
    }
  }
  if (!usable(result.amount)) return std::nullopt;
  return result;
}

}  // namespace

Rows::Rows(const std::vector<PointConstraint>& constraints) {
  weights_.reserve(constraints.size());
  goals_.reserve(constraints.size());
  masks_.reserve(constraints.size());
  for (const PointConstraint& constraint : constraints) add(constraint);
}

void Rows::add(const PointConstraint& constraint) {
  weights_.push_back(constraint.weights);
  goals_.push_back(constraint.goal);
  masks_.push_back(Vec3::Ones());
}

void Rows::add_fixed(const Weights& weights, const Vec3& mask) {
  weights_.push_back(weights);
  goals_.emplace_back();
  goals_.back().fill(Vec3::Zero());
  masks_.push_back(mask);
}

std::optional<Fit> fit(const Candidate& candidate, const Rows& rows, double tolerance) {
  return candidate.what.op == Op::rotate ? fit_rotation(candidate, rows, tolerance)
                                         : fit_linear(candidate, rows, tolerance);
}

double missed_by(const Candidate& candidate, const Samples& amount, const Rows& rows) {
  double worst = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Vec3 v = rows.at(i, candidate.field);
    for (std::size_t s = 0; s < sample_count; ++s) {
      const Vec3 moved =
          candidate.what.op == Op::rotate ? turned(v, candidate.what.direction, amount[s]) : Vec3(amount[s] * v);
      worst = std::max(worst, (rows.masked(i, moved) - rows.goal(i, s)).cwiseAbs().maxCoeff());
    }
  }
  return worst;
}

std::optional<Fit> fit_pair(const Candidate& first, const Candidate& second, const Rows& rows, double tolerance) {
  std::vector<Vec3> u(rows.size());
  std::vector<Vec3> v(rows.size());
  double uu = 0;
  double uv = 0;
  double vv = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    u[i] = rows.masked(i, rows.at(i, first.field));
    v[i] = rows.masked(i, rows.at(i, second.field));
    uu += u[i].squaredNorm();
    uv += u[i].dot(v[i]);
    vv += v[i].squaredNorm();
  }
  const double determinant = uu * vv - uv * uv;
  // Nearly parallel fields would be played against each other with large amounts.
  if (determinant < 1e-4 * uu * vv || uu < shortest_field * shortest_field || vv < shortest_field * shortest_field) {
    return std::nullopt;
  }
  Fit result;
  for (std::size_t s = 0; s < sample_count; ++s) {
    double ur = 0;
    double vr = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      ur += u[i].dot(rows.goal(i, s));
      vr += v[i].dot(rows.goal(i, s));
    }
    const double a = (vv * ur - uv * vr) / determinant;
    const double b = (uu * vr - uv * ur) / determinant;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double miss = (a * u[i] + b * v[i] - rows.goal(i, s)).cwiseAbs().maxCoeff();
      if (!(miss <= tolerance)) return std::nullopt;
      result.error = std::max(result.error, miss);
    }
    result.amount[s] = a;
    result.second[s] = b;
  }
  if (!usable(result.amount) || !usable(result.second)) return std::nullopt;
  return result;
}

}  // namespace parsel
