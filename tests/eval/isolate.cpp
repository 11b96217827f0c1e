#include "tests/eval/isolate.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace parsel::eval {
namespace {

void send_all(int descriptor, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t written = write(descriptor, text.data() + at, text.size() - at);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) _exit(3);  // nobody listens any more
    at += static_cast<std::size_t>(written);
  }
}

std::string last_line(FILE* file) {
  std::rewind(file);
  std::string line;
  std::array<char, 1024> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), file) != nullptr) line = buffer.data();
  while (!line.empty() && line.back() == '\n') line.pop_back();
  return line;
}

}  // namespace

Ending run_isolated(const std::function<void(const std::function<void(const std::string&)>& send)>& work,
                    const std::function<void(const std::string& line)>& receive, double seconds) {
  std::array<int, 2> ends{};
  FILE* const messages = std::tmpfile();
  if (messages == nullptr || pipe(ends.data()) != 0) throw std::runtime_error("no pipe or temporary file can be made");
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process can be made");
  if (child == 0) {
    close(ends[0]);
    dup2(fileno(messages), STDERR_FILENO);
    work([&](const std::string& line) { send_all(ends[1], line + "\n"); });
    _exit(0);
  }
  close(ends[1]);

  Ending ending;
  std::string pending;
  using Clock = std::chrono::steady_clock;
  auto last = Clock::now();
  while (true) {
    const double waited = std::chrono::duration<double>(Clock::now() - last).count();
    pollfd watched{ends[0], POLLIN, 0};
    const int ready = waited >= seconds ? 0 : poll(&watched, 1, static_cast<int>(1e3 * (seconds - waited)) + 1);
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) {
      ending.kind = Ending::Kind::timed_out;
      kill(child, SIGKILL);
      break;
    }
    std::array<char, 65536> buffer{};
    const ssize_t count = read(ends[0], buffer.data(), buffer.size());
    if (count <= 0) break;
    pending.append(buffer.data(), static_cast<std::size_t>(count));
    for (std::size_t end = 0; (end = pending.find('\n')) != std::string::npos;) {
      receive(pending.substr(0, end));
      pending.erase(0, end + 1);
      last = Clock::now();
    }
  }
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (ending.kind != Ending::Kind::timed_out && !(WIFEXITED(status) && WEXITSTATUS(status) == 0)) {
    ending.kind = Ending::Kind::crashed;
    ending.detail = WIFSIGNALED(status) ? std::string("signal: ") + strsignal(WTERMSIG(status))
                                        : "exit code " + std::to_string(WEXITSTATUS(status));
  }
  const std::string message = last_line(messages);
  std::fclose(messages);
  if (!message.empty() && ending.kind != Ending::Kind::done) {
    ending.detail += (ending.detail.empty() ? "" : "; ") + message;
  }
  return ending;
}

}  // namespace parsel::eval
