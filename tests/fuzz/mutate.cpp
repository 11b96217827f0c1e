#include "tests/fuzz/mutate.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

namespace parsel::fuzz {

namespace {

// Members keep their order, as files have them in any.
using json = nlohmann::ordered_json;

template <class List>
const auto& one_of(const List& list, Random& random) {
  return list[static_cast<std::size_t>(random.below(list.size()))];
}

/// Every value below `root`, itself left out.
void collect(json& root, std::vector<json*>& out) {
  if (!root.is_structured()) return;
  for (json& child : root) {
    out.push_back(&child);
    collect(child, out);
  }
}

json hard_number(Random& random) {
  static const std::vector<json> numbers = {
      0,          1,    2,     3,    -1,    7,    63,   64,   255,  4096, 65535, 65536, 1 << 30, -0.0, 0.5,        -0.5,
      4294967295, 1e-9, 1e-30, 1e30, 1e300, 5120, 5121, 5122, 5123, 5125, 5126,  0.1,   0.35,    -1.5, 2147483647, 12};
  return one_of(numbers, random);
}

json hard_text(Random& random) {
  static const std::vector<std::string> texts = {"",
                                                 "part",
                                                 "seat",
                                                 "leg_1",
                                                 "t1",
                                                 "r1",
                                                 "a1",
                                                 "node:0",
                                                 "node:1",
                                                 "x",
                                                 "2*x",
                                                 "x*x",
                                                 "sin(x)",
                                                 "floor(8*x)",
                                                 "1/x",
                                                 "sqrt(x)",
                                                 "-x",
                                                 "x+0.1",
                                                 "abs(x)-x",
                                                 "max(x,0)",
                                                 "atan2(x,1)",
                                                 "1e-9*x",
                                                 "1000*x",
                                                 "min(x,0.1)",
                                                 "x^9",
                                                 "pi*x",
                                                 "VEC3",
                                                 "SCALAR",
                                                 "MAT4",
                                                 "scale_1d",
                                                 "scale_2d",
                                                 "scale_3d",
                                                 "translate",
                                                 "rotate",
                                                 "shear",
                                                 "keep_fixed",
                                                 "change_count",
                                                 "change_delta",
                                                 "kind:reflection",
                                                 "KHR_draco_mesh_compression",
                                                 "стол",
                                                 "椅子",
                                                 "\u202eseat",
                                                 "../../etc",
                                                 "data:,x",
                                                 "fit",
                                                 "start",
                                                 "end"};
  return one_of(texts, random);
}

json hard_value(Random& random) {
  switch (random.below(8)) {
    case 0:
      return nullptr;
    case 1:
      return json::array();
    case 2:
      return json::object();
    case 3:
      return hard_text(random);
    case 4: {
      json deep = 1;
      for (std::uint64_t levels = random.below(80); levels > 0; --levels) deep = json::array({std::move(deep)});
      return deep;
    }
    default:
      return hard_number(random);
  }
}

/// A value of the same kind, near or hard.
json changed(const json& value, Random& random) {
  if (random.below(12) == 0) return hard_value(random);
  if (value.is_string()) return hard_text(random);
  if (value.is_number_integer() && random.below(2) == 0) {
    return value.get<std::int64_t>() + static_cast<std::int64_t>(random.below(9)) - 4;
  }
  if (value.is_number_float() && random.below(3) != 0) return value.get<double>() * random.uniform(-2, 2);
  if (value.is_number()) return hard_number(random);
  return hard_value(random);
}

void mutate_json(json& root, Random& random) {
  std::vector<json*> all;
  collect(root, all);
  if (all.empty()) return;
  json& target = *one_of(all, random);
  switch (random.below(10)) {
    case 0:  // drop a child
      if (target.is_array() && !target.empty()) {
        target.erase(static_cast<std::size_t>(random.below(target.size())));
      } else if (target.is_object() && !target.empty()) {
        auto member = target.begin();
        std::advance(member, static_cast<std::ptrdiff_t>(random.below(target.size())));
        target.erase(member);
      }
      return;
    case 1:  // double a child
      if (target.is_array() && !target.empty()) target.push_back(json(one_of(target, random)));
      return;
    case 2: {  // put a copy of another place here
      const json copy = *one_of(all, random);
      if (copy.dump().size() < 2'000) target = copy;
      return;
    }
    case 3:  // move two children of a list
      if (target.is_array() && target.size() > 1) std::swap(target.front(), target.back());
      return;
    default:
      if (!target.is_structured() || random.below(20) == 0) target = changed(target, random);
  }
}

std::uint32_t read_u32(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) value |= std::uint32_t{static_cast<unsigned char>(bytes[at + k])} << (8 * k);
  return value;
}

void put_u32(std::string& bytes, std::size_t value) {
  for (std::size_t k = 0; k < 4; ++k) bytes += static_cast<char>(value >> (8 * k) & 0xff);
}

std::string container(std::string text, std::string binary) {
  text.append((4 - text.size() % 4) % 4, ' ');
  binary.append((4 - binary.size() % 4) % 4, '\0');
  std::string out = "glTF";
  put_u32(out, 2);
  put_u32(out, 20 + text.size() + (binary.empty() ? 0 : 8 + binary.size()));
  put_u32(out, text.size());
  out += "JSON" + text;
  if (binary.empty()) return out;
  put_u32(out, binary.size());
  return out + std::string("BIN\0", 4) + binary;
}

void put_float(std::string& binary, std::size_t at, float value) {
  std::memcpy(binary.data() + at, &value, 4);
}

/// Numbers in the binary chunk: most of them are coordinates.
void mutate_binary(std::string& binary, Random& random) {
  if (binary.size() < 16) return;
  static constexpr std::array hard = {0.0F,  -0.0F,  1e30F, 1e-30F, std::numeric_limits<float>::infinity(),
                                      1e-6F, 1.0F,   -1.0F, 0.5F,   std::numeric_limits<float>::quiet_NaN(),
                                      3e38F, 1e-45F, 1e6F};
  const std::size_t floats = binary.size() / 4;
  const std::size_t first = static_cast<std::size_t>(random.below(floats));
  const std::size_t count = std::min(floats - first, static_cast<std::size_t>(1 + random.below(72)));
  switch (random.below(4)) {
    case 0:
      put_float(binary, 4 * first, one_of(hard, random));
      return;
    case 1:
      binary[static_cast<std::size_t>(random.below(binary.size()))] ^= static_cast<char>(1 << random.below(8));
      return;
    default: {  // a run of coordinates is moved, stretched or flattened: parts overlap, turn over, lose a dimension
      const auto factor = static_cast<float>(random.below(4) == 0 ? 0 : random.uniform(-1.5, 1.5));
      const auto shift = static_cast<float>(random.below(2) == 0 ? 0 : random.uniform(-0.5, 0.5));
      const std::size_t step = random.below(2) == 0 ? 3 : 1;
      for (std::size_t k = 0; k < count; k += step) {
        float value = 0;
        std::memcpy(&value, binary.data() + 4 * (first + k), 4);
        put_float(binary, 4 * (first + k), value * factor + shift);
      }
    }
  }
}

std::string mutated_glb(const std::string& glb, Random& random) {
  std::string bytes = glb;
  const bool whole = bytes.size() > 28 && bytes.starts_with("glTF");
  const std::size_t size = whole ? read_u32(bytes, 12) : 0;
  json document = whole && size <= bytes.size() - 20 ? json::parse(bytes.substr(20, size), nullptr, false) : json();
  if (!document.is_object() || random.below(25) == 0) {  // not as GLB: single bytes, or the end cut off
    for (std::uint64_t times = 1 + random.below(4); times > 0 && !bytes.empty(); --times) {
      bytes[static_cast<std::size_t>(random.below(bytes.size()))] = static_cast<char>(random.below(256));
    }
    if (random.below(4) == 0) bytes.resize(static_cast<std::size_t>(random.below(bytes.size() + 1)));
    return bytes;
  }
  std::string binary = bytes.size() > 28 + size ? bytes.substr(28 + size) : "";
  for (std::uint64_t times = random.below(4); times > 0; --times) mutate_json(document, random);
  for (std::uint64_t times = random.below(4); times > 0; --times) mutate_binary(binary, random);
  return container(document.dump(-1, ' ', false, json::error_handler_t::replace), binary);
}

std::string mutated_edit(const std::string& edit, Random& random) {
  json document = json::parse(edit, nullptr, false);
  if (document.is_discarded() || random.below(40) == 0) {
    std::string bytes = edit;
    if (!bytes.empty())
      bytes[static_cast<std::size_t>(random.below(bytes.size()))] = static_cast<char>(random.below(256));
    return bytes;
  }
  for (std::uint64_t times = random.below(4); times > 0; --times) mutate_json(document, random);
  return document.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace

Input mutated(const Input& seed, Random& random) {
  // One of the two often stays as it is: else the other's faults hide behind its refusals.
  const std::uint64_t which = random.below(5);
  return {which < 2 ? seed.glb : mutated_glb(seed.glb, random),
          which == 2 ? seed.edit : mutated_edit(seed.edit, random)};
}

}  // namespace parsel::fuzz
