// Evaluates the text of an amount while reading it: the grammar at the top of core/edit/amount.h, rule by rule.
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/base/tolerance.h"
#include "core/check/replay.h"

namespace parsel::replay {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

class Reader {
 public:
  Reader(const std::string& text, const std::map<std::string, double>& parameters)
      : text_(text), parameters_(parameters) {}

  double all() {
    const double value = sum();
    blanks();
    return readable_ && at_ == text_.size() ? value : nothing;
  }

 private:
  void blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool take(char c) {
    blanks();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  double fail() {
    readable_ = false;
    return nothing;
  }
  static double finite(double value) { return std::isfinite(value) ? value : nothing; }

  double sum() {
    double value = product();
    while (readable_) {
      if (take('+')) {
        value = finite(value + product());
      } else if (take('-')) {
        value = finite(value - product());
      } else {
        break;
      }
    }
    return value;
  }

  double product() {
    double value = unary();
    while (readable_) {
      if (take('*')) {
        value = finite(value * unary());
      } else if (take('/')) {
        value = finite(value / unary());
      } else {
        break;
      }
    }
    return value;
  }

  double unary() {
    if (++depth_ > 500) return fail();
    const double value = take('-') ? -unary() : take('+') ? unary() : power();
    --depth_;
    return value;
  }

  double power() {
    const double base = primary();
    return take('^') ? finite(std::pow(base, unary())) : base;
  }

  double primary() {
    blanks();
    if (take('(')) {
      const double value = sum();
      return take(')') ? value : fail();
    }
    if (at_ >= text_.size()) return fail();
    const char c = text_[at_];
    if (std::isdigit(static_cast<unsigned char>(c)) || c == '.') {
      const char* begin = text_.c_str() + at_;
      char* end = nullptr;
      const double value = std::strtod(begin, &end);
      if (end == begin) return fail();
      at_ += static_cast<std::size_t>(end - begin);
      return value;
    }
    std::string name;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_')) {
      name += text_[at_++];
    }
    if (name == "pi") return pi;
    if (take('(')) return function(name);
    const auto found = parameters_.find(name);
    return found == parameters_.end() ? fail() : found->second;
  }

  double function(const std::string& name) {
    std::vector<double> arguments;
    do {
      arguments.push_back(sum());
    } while (readable_ && take(','));
    if (!readable_ || !take(')')) return fail();
    const double a = arguments[0];
    if (arguments.size() == 1) {
      if (name == "sqrt") return a < 0 && a > -1e-12 ? 0 : finite(std::sqrt(a));
      if (name == "abs") return std::abs(a);
      if (name == "floor") return std::floor(a + 1e-9);
      if (name == "sin") return std::sin(a);
      if (name == "cos") return std::cos(a);
      if (name == "tan") return finite(std::sin(a) / std::cos(a));
      return fail();
    }
    if (name == "atan2" && arguments.size() == 2) {
      const double x = arguments[1] + 0.0;
      return x < 0 && a <= 0 && a >= 1e-12 * x ? pi : std::atan2(a, x);
    }
    if (name != "min" && name != "max") return fail();
    double best = a;
    for (const double b : arguments) {
      if (std::isnan(b)) return nothing;
      if (name == "min" ? b < best : b > best) best = b;
    }
    return best;
  }

  const std::string& text_;
  const std::map<std::string, double>& parameters_;
  std::size_t at_ = 0;
  int depth_ = 0;
  bool readable_ = true;
};

}  // namespace

double value_of(const std::string& text, const std::map<std::string, double>& parameters) {
  return Reader(text, parameters).all();
}

}  // namespace parsel::replay
