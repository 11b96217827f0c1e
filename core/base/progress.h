// How long work reports where it is. Called from inside the work; must return quickly.
#pragma once

#include <functional>
#include <string>

namespace parsel {

/// step: what is being done, for people; done of total. May be empty (nobody listens).
using Progress = std::function<void(const std::string& step, int done, int total)>;

inline void report(const Progress& progress, const std::string& step, int done, int total) {
  if (progress) progress(step, done, total);
}

}  // namespace parsel
