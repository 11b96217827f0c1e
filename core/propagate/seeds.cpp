#include "core/propagate/seeds.h"

#include <algorithm>
#include <cmath>

#include "core/base/tolerance.h"
#include "core/propagate/closed_form.h"
#include "core/propagate/transfer.h"

namespace parsel {

namespace {

constexpr const char* stage = "propagate";
/// A seed must be able to go at least this far to one side, as a share of the limit.
constexpr double least_range = 0.02;

bool is_alive(const Corners& corners, const Corners& rest) {
  return corners.allFinite() && relative_jacobians(corners, rest).minCoeff() > collapse_ratio;
}

class Applier {
 public:
  Applier(const Graph& graph, const ResolvedRequest& request, const PropagateOptions& options)
      : shape_(graph.shape()), graph_(graph), request_(request), options_(options) {
    seeds_.edits = Edits(shape_.parts.size());
  }

  Result<Seeds> run() {
    const GiNaC::symbol& x = parameter_symbol(edit_parameter);
    const GiNaC::symbol& own = parameter_symbol(options_.parameter);
    std::vector<PartIndex> parts;
    PartData<std::vector<Step>> steps(shape_.parts.size());
    PartData<std::vector<int>> indices(shape_.parts.size());
    for (std::size_t i = 0; i < request_.seed.size(); ++i) {
      Statement statement = request_.seed[i];
      statement.amount = Amount(statement.amount.expression().subs(x == own));
      statement.why = Why{WhyKind::seed, {}};
      const PartIndex part = request_.seed_parts[i];
      if (std::find(parts.begin(), parts.end(), part) == parts.end()) parts.push_back(part);
      Step step = to_step(shape_, statement);
      if (step.what.op != Op::keep_fixed) steps[part].push_back(std::move(step));
      indices[part].push_back(static_cast<int>(seeds_.statements.size()));
      seeds_.statements.push_back(std::move(statement));
    }
    if (Status status = find_working_range(parts, steps); !status.ok()) return status.error();
    for (const PartIndex part : parts) {
      for (Step& step : steps[part]) step.values = *sampled(step.amount, options_.parameter, seeds_.at);
      TraceStep trace;
      trace.part = id(part);
      trace.kind = "seed";
      trace.statements = indices[part];
      const bool is_asked = indices[part].front() < static_cast<int>(request_.asked);
      trace.why = is_asked ? "the edit asked for" : "its instances hang on those of a row that changes";
      seeds_.edits[part] =
          std::make_shared<const PartEdit>(PartEdit{steps[part], motion_of(shape_, part, steps[part])});
      seeds_.trace.push_back(std::move(trace));
    }
    note_conflicts(parts);
    return std::move(seeds_);
  }

 private:
  const std::string& id(PartIndex part) const { return shape_.parts[part].id; }
  const std::string& id(RelationIndex relation) const { return shape_.relations[relation].id; }

  Status find_working_range(const std::vector<PartIndex>& parts, const PartData<std::vector<Step>>& steps) {
    constexpr int batches = 8;
    constexpr int grid = batches * static_cast<int>(sample_count);
    std::string culprit;
    const auto reach = [&](double sign) {
      for (int batch = 0; batch < batches; ++batch) {
        Samples at;
        for (std::size_t s = 0; s < sample_count; ++s) {
          at[s] = sign * options_.limit * (batch * static_cast<int>(sample_count) + static_cast<int>(s) + 1) / grid;
        }
        std::size_t good = sample_count;
        for (const PartIndex part : parts) {
          std::vector<Step> sampled_steps = steps[part];
          for (Step& step : sampled_steps) {
            const CompiledAmount amount = Amount(step.amount).compile({options_.parameter});
            for (std::size_t s = 0; s < sample_count; ++s) step.values[s] = amount(&at[s]);
          }
          const Corners& rest = shape_.parts[part].hexahedron.corners;
          const Motion motion = motion_of(shape_, part, sampled_steps);
          for (std::size_t s = 0; s < good; ++s) {
            if (!is_alive(rest + motion[s], rest)) {
              good = s;
              culprit = id(part);
            }
          }
        }
        if (good < sample_count)
          return good == 0 ? (batch == 0 ? 0.0 : at[0] - sign * options_.limit / grid) : at[good - 1];
      }
      return sign * options_.limit;
    };
    const double high = reach(1);
    const double low = reach(-1);
    if (high - low < least_range * options_.limit) {
      return Error{stage, "/seed", "the seed edit turns part '" + culprit + "' inside out, or is undefined, at once",
                   "use a smaller or another amount"};
    }
    seeds_.at = sample_points(low, high);
    return success();
  }

  void note_conflicts(const std::vector<PartIndex>& parts) {
    for (const PartIndex part : parts) {
      for (const RelationIndex relation : graph_.relations(part)) {
        const PartIndex other = graph_.other(relation, part);
        if (other < part || !seeds_.edits[other]) continue;
        std::vector<PointConstraint> constraints;
        add_constraints(graph_, relation, part, seeds_.edits, constraints);
        if (residuals(constraints, seeds_.edits[part]->motion)[0].second <= delta_both_edited) continue;
        seeds_.notes.push_back("the seed edits of " + id(part) + " and " + id(other) + " break " + id(relation) +
                               " between them");
      }
    }
  }

  const Shape& shape_;
  const Graph& graph_;
  const ResolvedRequest& request_;
  const PropagateOptions& options_;
  Seeds seeds_;
};

}  // namespace

Result<Seeds> apply_seeds(const Graph& graph, const ResolvedRequest& request, const PropagateOptions& options) {
  return Applier(graph, request, options).run();
}

}  // namespace parsel
