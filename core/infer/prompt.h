// From a request to the texts that the language model gets. ParSEL §6.2.1, supplement §5.2.
//
// A template holds {{places}}; what is put in is never looked at again, so that a name cannot open a place of its own.
// Names come from the model's file, so from strangers: they stand between double quotes on a line that we began
// (core/shape/words.h), and so does the request.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/infer/task.h"

namespace parsel {

/// What a person asks for.
struct EditWish {
  std::string request;                 ///< in words: UTF-8, not blank, at most ProgramLimits::request_bytes
  std::vector<std::string> mentioned;  ///< ids of the parts that the person pointed at
  int count = 0;                       ///< how many proposals, 1 to most_proposals; 0: as many as the task says
  bool picture = false;                ///< of the model, with numbers on its parts, goes along with the prompt
};

/// Parts that a prompt may list under numbers; a reply says something of each.
inline constexpr std::size_t most_numbered = 200;

/// What stands under the number i + 1 in the picture that goes along with a task's prompt: the active parts, or those
/// that the task numbers.
std::vector<PartIndex> numbered_parts(const Shape& shape, const Task& task);

/// The parts that a wish mentions; or why it cannot be asked: blank, too long, or about parts that are not there.
Result<std::vector<PartIndex>> check_wish(const Shape& shape, const EditWish& wish);

struct Prompt {
  const Task* task = nullptr;
  AboutRelation relation;
  std::string text;
  std::string hash;     ///< SHA-256 of the text, in hex
  std::string version;  ///< of the template
};

/// `relation` is needed by the tasks that ask about one, of the kind that they ask about, and refused by the others; so
/// is the wish's request. A count and a picture are for the tasks that propose.
Result<Prompt> make_prompt(const Shape& shape, const EditWish& wish, const Task& task, AboutRelation relation = {});

/// Every prompt that a request is read by: those about the whole of it, then one for each active relation that a task
/// asks about (all groups standing).
Result<std::vector<Prompt>> make_prompts(const Shape& shape, const EditWish& wish);

/// What a template says once its places are filled.
struct Rendered {
  std::string text;
  std::string hash;     ///< SHA-256 of the text, in hex
  std::string version;  ///< of the template
};
/// The template prompts/<task>.md, which there is, with its places filled.
Rendered render(std::string_view task, const Places& places);

/// Words of a person as a template may hold them: on one line between double quotes, escaped as in JSON, without
/// backquotes, so that no code block can open; cut to ProgramLimits::request_bytes.
std::string quoted_words(std::string_view words);

/// {"task", "relation": id or null, "text", "hash", "version"}
nlohmann::json to_json(const Shape& shape, const Prompt& prompt);

/// The JSON schema of the block that ends a reply.
nlohmann::json reply_schema(const Task& task);
nlohmann::json reply_schema(std::string_view task);

}  // namespace parsel
