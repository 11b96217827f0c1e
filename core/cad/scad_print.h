// Pieces of OpenSCAD text that flat programs and families are printed from.
#pragma once

#include <functional>
#include <string>

#include "core/cad/model.h"

namespace parsel::cad {

/// The shortest decimal that reads back to the same double, with an exponent only below 1e-4 and from 1e15.
std::string decimal(double value);

/// A part's quantities as text: literals, or expressions of a family's variables. Axes are ours.
struct PartText {
  std::array<std::string, 3> centre, size;
  std::string minus_z;  ///< the negated third coordinate of the centre, which is OpenSCAD's second
  std::string top;
  bool is_round = true;  ///< both diameters across its axis are the same text
};

PartText literal_text(const Part& part);

/// One statement without its end of line: `translate([…]) rotate([…]) cylinder(…);`
std::string statement_of(const Part& part, const PartText& text);

/// The program of a tree: every leaf printed by `leaf(part, indentation)`, several lines if need be.
std::string tree_text(const Model& model,
                      const std::function<std::string(std::size_t part, const std::string& indent)>& leaf);

}  // namespace parsel::cad
