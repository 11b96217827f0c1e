// Writes the seed statements of plain requests, and how far the slider must go for an amount that was named.
#pragma once

#include <optional>

#include "core/infer/plain_edit.h"
#include "core/infer/plain_facts.h"

namespace parsel {

/// One edit, of one statement; `sign` -1 for the opposite of what a method says.
class StatementMaker {
 public:
  StatementMaker(const ShapeFacts& facts, int sign) : facts_(facts), sign_(sign) {}

  PlainEdit edit;

  /// Along an axis of the part; `at` stays. With a feature, only that.
  void stretch(PartIndex part, int axis, const LocalTriple& at, const LocalTriple& feature = {0, 0, 0});
  /// Across the axis, about the middle of the feature.
  void widen_round(PartIndex part, int axis, const LocalTriple& feature);
  /// In all directions; `at` stays.
  void grow(PartIndex part, const LocalTriple& at = {0, 0, 0});
  void move(PartIndex part, const Side& to);
  /// The face on that side goes outwards.
  void move_face(PartIndex part, const Side& side);
  /// Its top goes that way; `end` stays.
  void tilt(PartIndex part, const Side& way, const LocalTriple& end);
  /// Its front opens about its upright edge at the back on the side `hinge` (1 its left).
  void swing(PartIndex part, int hinge);
  void more(PartIndex group);
  void space(PartIndex group);
  /// An amount is that of the whole along this axis.
  void of_whole(int axis) { whole_axis_ = axis; }

  /// The edit with its amount. `compares`: the sign was said.
  Meant finish(const std::optional<HowMuch>& how_much, bool compares) const;

 private:
  enum class Quantity { ratio, distance, angle, pieces };
  Statement& add(Op op, PartIndex part, const LocalTriple& feature = {0, 0, 0});
  DirectionReference direction(PartIndex part, int axis) const;
  void measured(Quantity quantity, PartIndex part, const char* what, double length);
  /// How far, in the quantity's unit and with its sign, or why not.
  Result<double> reach(const HowMuch& how_much, bool compares) const;

  const ShapeFacts& facts_;
  int sign_;
  Quantity quantity_ = Quantity::ratio;
  PartIndex part_;
  const char* what_ = "";
  double length_ = 1;  ///< of what a ratio is of; the number of pieces
  std::optional<int> whole_axis_;
};

}  // namespace parsel
