#include "core/cad/scad_flatten.h"

#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/cad/customizer.h"
#include "core/cad/label_note.h"
#include "core/cad/placing.h"
#include "core/cad/scad_arguments.h"
#include "core/cad/scad_colour.h"
#include "core/cad/scad_parse.h"
#include "core/cad/scad_solids.h"
#include "core/cad/scad_token.h"

namespace parsel::cad {

namespace {

/// The children of a call of a module, in the scope of whoever calls it.
struct Children {
  const Statements* statements = nullptr;
  const Scope* scope = nullptr;
  const Children* outer = nullptr;
};

/// What goes down with every statement.
struct Surroundings {
  Map map = to_gltf_frame();
  std::array<Place, 3> moved;  ///< the literals that last moved it along each axis of ours
  std::array<double, 4> colour{0, 0, 0, 0};
  std::string label;
  const Children* children = nullptr;
  std::optional<Extrusion> extrusion;  ///< inside linear_extrude
};

bool is_geometry(const Statement& statement) {
  return statement.kind == Statement::Kind::call || statement.kind == Statement::Kind::choice ||
         statement.kind == Statement::Kind::block;
}

class Flattener {
 public:
  explicit Flattener(std::string_view name) { model_.name = printable(name, 200); }

  Model run(const Statements& program) {
    Scope scope;
    evaluator_.open_block(program, scope);
    model_.ranges = customizer_ranges(program);
    const Node tree = unite(run_statements(program, scope, Surroundings{}));
    // What came to nothing, or is not what ! shows, leaves the model.
    std::vector<Part> kept;
    model_.tree = renumbered(root_ ? *root_ : tree, kept);
    model_.parts = std::move(kept);
    if (model_.parts.empty()) {
      throw Refused{refusal({}, "the program makes no solid", "call a module, or add a cube")};
    }
    return std::move(model_);
  }

 private:
  using Nodes = std::vector<Node>;

  static Node unite(Nodes nodes) {
    if (nodes.size() == 1) return std::move(nodes.front());
    Node node;
    for (Node& child : nodes) {
      if (child.op == Node::Op::unite) {
        std::move(child.children.begin(), child.children.end(), std::back_inserter(node.children));
      } else {
        node.children.push_back(std::move(child));
      }
    }
    return node;
  }

  static bool is_empty(const Node& node) { return node.op != Node::Op::leaf && node.children.empty(); }

  Nodes run_statements(const Statements& statements, const Scope& scope, const Surroundings& around) {
    Nodes nodes;
    for (const Statement& statement : statements) {
      if (is_geometry(statement)) nodes.push_back(run_statement(statement, scope, around));
    }
    return nodes;
  }

  Nodes run_block(const Statements& statements, const Scope& outer, const Surroundings& around) {
    const Evaluator::Specials specials(evaluator_);
    Scope scope;
    scope.outer = &outer;
    evaluator_.open_block(statements, scope);
    return run_statements(statements, scope, around);
  }

  Node run_statement(const Statement& statement, const Scope& scope, const Surroundings& outer) {
    constexpr std::size_t cost = 5;
    const Evaluator::Level level(evaluator_, statement.place, cost);
    evaluator_.step(statement.place);
    Surroundings around = outer;
    if (const std::string label = label_from_note(statement.note); !label.empty()) around.label = label;
    if (statement.kind == Statement::Kind::block) return unite(run_block(statement.children, scope, around));
    if (statement.modifier == '*') return {};
    if (statement.modifier == '%') {
      warn(statement.place, "what % shows as background is left out");
      return {};
    }
    Node node;
    if (statement.kind == Statement::Kind::choice) {
      const bool is_true = evaluator_.evaluate(*statement.value, scope).is_true();
      node = unite(run_block(is_true ? statement.children : statement.otherwise, scope, around));
    } else {
      node = run_call(statement, scope, around, label_from_note(statement.note).empty());
    }
    if (statement.modifier == '!' && !root_) root_ = node;
    return node;
  }

  Node run_call(const Statement& call, const Scope& scope, Surroundings& around, bool is_unlabelled) {
    const Definition found = Evaluator::find_module(scope, call.name);
    if (!found.statement) return run_own(call, scope, around);
    if (is_unlabelled) around.label = call.name;
    const Evaluator::Specials specials(evaluator_);
    Scope inner = evaluator_.bind(found.statement->arguments, call.arguments, scope, found.home);
    const Children children{&call.children, &scope, around.children};
    around.children = &children;
    const auto count = std::count_if(call.children.begin(), call.children.end(), is_geometry);
    evaluator_.push_special("$children", double(count));
    const Statements& body = found.statement->children;
    if (body.size() == 1 && body[0].kind == Statement::Kind::block) {
      return unite(run_block(body[0].children, inner, around));
    }
    return unite(run_block(body, inner, around));
  }

  /// OpenSCAD's own modules.
  Node run_own(const Statement& call, const Scope& scope, Surroundings& around) {
    const std::string& name = call.name;
    const auto arguments = [&](std::initializer_list<std::string_view> names) {
      return CallArguments(evaluator_, call, scope, names);
    };
    if (const auto solid = read_solid(evaluator_, call, scope, around.extrusion)) return add(*solid, call, around);
    if (const auto map = read_map(evaluator_, call, scope)) {
      if (name == "translate") note_translation(arguments({"v"}), around);
      around.map = around.map.after(*map);
      return unite(run_block(call.children, scope, around));
    }
    if (name == "union" || name == "group" || name == "render") return unite(run_block(call.children, scope, around));
    if (name == "difference" || name == "intersection") {
      return combine(name == "difference" ? Node::Op::subtract : Node::Op::intersect,
                     run_block(call.children, scope, around));
    }
    if (name == "color") {
      const CallArguments given = arguments({"c", "alpha"});
      // The outermost colour counts in OpenSCAD.
      if (around.colour[3] == 0) around.colour = read_colour(given);
      return unite(run_block(call.children, scope, around));
    }
    if (name == "for" || name == "intersection_for") {
      Nodes nodes;
      evaluator_.loop(call.arguments, scope,
                      [&](const Scope& inner) { nodes.push_back(unite(run_block(call.children, inner, around))); });
      return name == "for" ? unite(std::move(nodes)) : combine(Node::Op::intersect, std::move(nodes));
    }
    if (name == "let" || name == "assign") {
      const Evaluator::Specials specials(evaluator_);
      const Scope inner = evaluator_.let(call.arguments, scope);
      return unite(run_block(call.children, inner, around));
    }
    if (name == "children" || name == "child") return run_children(arguments({"index"}), around);
    if (name == "linear_extrude") {
      const CallArguments given = arguments({"height", "center", "convexity", "twist"});
      around.extrusion = read_extrusion(given);
      return unite(run_block(call.children, scope, around));
    }
    if (name == "hull") return run_hull(call, scope, around);
    if (name == "echo" || name == "assert") return run_message(call, scope, around);
    refuse_module(call);
  }

  Node run_message(const Statement& call, const Scope& scope, const Surroundings& around) {
    if (call.name == "echo") {
      std::string text;
      for (const Argument& argument : call.arguments) {
        if (!text.empty()) text += ", ";
        if (!argument.name.empty()) text += argument.name + " = ";
        text += to_string(evaluator_.evaluate(*argument.value, scope));
      }
      if (model_.echoes.size() < Limits::notices) model_.echoes.push_back({call.place, printable(text, 200)});
    } else if (!call.arguments.empty() && !evaluator_.evaluate(*call.arguments[0].value, scope).is_true()) {
      throw Refused{refusal(call.place, "an assert of the program fails", "give it the values that it asks for")};
    }
    return unite(run_block(call.children, scope, around));
  }

  Node run_children(const CallArguments& given, Surroundings around) {
    const Children* children = around.children;
    if (!children) return {};
    around.children = children->outer;
    const Evaluator::Specials specials(evaluator_);
    Scope scope;
    scope.outer = children->scope;
    evaluator_.open_block(*children->statements, scope);
    std::vector<double> wanted;
    const Value& index = given["index"];
    if (index.number()) wanted = {index.number()->value};
    if (index.vector()) {
      for (const Value& one : *index.vector()) wanted.push_back(one.number() ? one.number()->value : -1);
    }
    if (const Range* range = index.range()) {
      for (double i = range->begin; i <= range->end && wanted.size() < Limits::parts; i += std::abs(range->step)) {
        wanted.push_back(i);
      }
    }
    Nodes nodes;
    double position = 0;
    for (const Statement& statement : *children->statements) {
      if (!is_geometry(statement)) continue;
      if (index.is_undefined() || std::find(wanted.begin(), wanted.end(), position) != wanted.end()) {
        nodes.push_back(run_statement(statement, scope, around));
      }
      ++position;
    }
    return unite(std::move(nodes));
  }

  Node combine(Node::Op op, Nodes nodes) {
    Node node;
    node.op = op;
    const bool is_nothing = nodes.empty() || is_empty(nodes.front()) ||
                            (op == Node::Op::intersect && std::any_of(nodes.begin(), nodes.end(), is_empty));
    if (is_nothing) return {};
    for (Node& each : nodes) {
      if (!is_empty(each)) node.children.push_back(std::move(each));
    }
    return node.children.size() == 1 ? Node(std::move(node.children.front())) : node;
  }

  Node run_hull(const Statement& call, const Scope& scope, const Surroundings& around) {
    const std::size_t first = model_.parts.size();
    const Node node = unite(run_block(call.children, scope, around));
    if (is_empty(node)) return {};
    if (node.op == Node::Op::leaf && model_.parts.back().kind != Kind::opaque) return node;
    Vec3 low = Vec3::Constant(1e300), high = -low;
    for (std::size_t i = first; i < model_.parts.size(); ++i) {
      const Extent box = extent(model_.parts[i]);
      low = low.cwiseMin(model_.parts[i].centre + box.low);
      high = high.cwiseMax(model_.parts[i].centre + box.high);
    }
    model_.parts.resize(first);
    root_.reset();
    Part part;
    part.kind = Kind::opaque;
    part.centre = (low + high) / 2;
    part.size = high - low;
    return keep(std::move(part), call, around);
  }

  Node add(const ReadSolid& solid, const Statement& call, const Surroundings& around) {
    std::optional<Part> part = placed(solid.raw, around.map);
    if (!part) {
      warn(call.place, call.name + " has no volume and is left out");
      return {};
    }
    for (int i = 0; i < 3; ++i) {
      int axis = 0;
      around.map.linear.col(i).cwiseAbs().maxCoeff(&axis);
      part->size_places[static_cast<std::size_t>(axis)] = solid.literals[static_cast<std::size_t>(i)];
    }
    return keep(std::move(*part), call, around);
  }

  Node keep(Part part, const Statement& call, const Surroundings& around) {
    if (part.kind == Kind::opaque) {
      warn(call.place, call.name + (call.name == "hull" || call.name == "polyhedron"
                                        ? " is kept as a closed part: only its box is known"
                                        : " does not lie along the axes: only its box is known"));
    }
    if (model_.parts.size() == Limits::parts) {
      throw Refused{refusal(call.place, "the program makes more than " + std::to_string(Limits::parts) + " parts",
                            "open a simpler program")};
    }
    part.place = call.place;
    part.centre_places = around.moved;
    part.colour = around.colour;
    part.label = around.label.empty() ? std::string(to_string(part.kind)) : around.label;
    Node node;
    node.op = Node::Op::leaf;
    node.part = model_.parts.size();
    model_.parts.push_back(std::move(part));
    return node;
  }

  void note_translation(const CallArguments& given, Surroundings& around) const {
    const auto by = given.triple("v", 0, false);
    for (int i = 0; by && i < 3; ++i) {
      int axis = 0;
      around.map.linear.col(i).cwiseAbs().maxCoeff(&axis);
      if (by->value[i] != 0) around.moved[static_cast<std::size_t>(axis)] = by->literals[static_cast<std::size_t>(i)];
    }
  }

  void warn(const Place& place, std::string text) {
    if (model_.warnings.size() < Limits::notices) model_.warnings.push_back({place, std::move(text)});
  }

  Node renumbered(const Node& node, std::vector<Part>& kept) const {
    Node made;
    made.op = node.op;
    if (node.op == Node::Op::leaf) {
      made.part = kept.size();
      kept.push_back(model_.parts[node.part]);
    }
    for (const Node& child : node.children) made.children.push_back(renumbered(child, kept));
    return made;
  }

  Evaluator evaluator_;
  Model model_;
  std::optional<Node> root_;  ///< what ! shows alone
};

}  // namespace

Result<Model> read_scad(std::string_view text, std::string_view name) {
  const Result<Statements> program = parse_scad(text);
  if (!program) return program.error();
  try {
    Model model = Flattener(name).run(*program);
    name_and_place(model);
    if (Status valid = validate(model); !valid) return valid.error();
    return model;
  } catch (const Refused& refused) {
    return refused.error;
  }
}

}  // namespace parsel::cad
