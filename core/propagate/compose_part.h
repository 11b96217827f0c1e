// One layer on those before it, part by part: what compose() (compose.h) does for a layer.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/edit/statement_run.h"
#include "core/propagate/closed_stack.h"
#include "core/prove/deviation.h"

namespace parsel {

class LayerComposer {
 public:
  /// `program` passed validate() for `shape`; its last layer is alone(). Both must live as long.
  LayerComposer(const Shape& shape, const Program& program);
  /// The last layer, composed onto the others.
  Layer run();

 private:
  /// A relation that each layer keeps alone.
  struct Tie {
    Constraint constraint;
    double tolerance = 0;
    double off_alone = 0;        ///< as far as the new layer alone lets it go
    std::set<PartIndex> movers;  ///< parts whose statements in the new layer move it
  };
  /// How well relations hold at the samples: cages that collapse or invert come first, then relations beyond their
  /// tolerance, then what they are off beyond what they are alone, added up.
  struct Score {
    int failed = 0, broken = 0;
    double off = 0, worst = 0;
    bool operator<(const Score& other) const;
  };
  /// One coordinate of one point of a part that is to go where a neighbour's goes.
  struct Equation {
    const Tie* tie = nullptr;
    bool is_first = false;  ///< whether the part is the relation's first
    int point = 0, coordinate = 0;
    double lever = 0;  ///< by how much it goes for a unit of the amount
  };
  using Statements = std::vector<Statement>;

  void choose_samples();
  void find_ties();
  void compose_part(PartIndex part, const std::vector<std::size_t>& numbers);
  Score score(const std::vector<const Tie*>& ties, const std::vector<PartIndex>& parts,
              const std::vector<State>& states) const;
  std::vector<const Tie*> all_ties() const;
  void commit(PartIndex part, const std::vector<std::size_t>& numbers, const Statements& statements);
  std::vector<State> moved(const Statements& statements) const;
  std::vector<const Tie*> ties_of(PartIndex part) const;
  std::vector<Equation> equations(PartIndex part, const Statements& statements, std::size_t unknown) const;
  std::optional<GiNaC::ex> goal(const Equation& equation, PartIndex part);
  std::optional<GiNaC::ex> solved(const Equation& equation, PartIndex part, const Statements& statements,
                                  std::size_t unknown);
  std::optional<std::vector<GiNaC::ex>> solved_pair(const Equation& first, const Equation& second, PartIndex part,
                                                    const Statements& statements);
  std::optional<GiNaC::ex> left(const Equation& equation, PartIndex part, const Statements& statements,
                                const std::vector<std::size_t>& unknowns);
  std::optional<GiNaC::ex> solved_turn(const Equation& equation, PartIndex part, const Statements& statements);
  std::optional<Amount> accepted(const GiNaC::ex& found, const Amount& alone) const;
  std::vector<Statements> turned_along(PartIndex part, const Statements& statements) const;

  const Shape& shape_;
  const Program& program_;
  std::size_t last_;
  Layer layer_;                ///< the last one as far as it is composed
  std::vector<Layer> layers_;  ///< all, with layer_ last: what closed_ reads
  std::vector<std::string> names_;
  std::vector<Group> groups_;
  std::vector<std::vector<double>> samples_;
  std::vector<State> starts_;  ///< at each sample, where the new layer starts
  std::vector<State> states_;  ///< … and with what is composed of it
  std::vector<Tie> ties_;
  std::set<PartIndex> done_;  ///< of the parts that the new layer edits
  std::set<PartIndex> edited_;
  ClosedStack closed_;
};

}  // namespace parsel
