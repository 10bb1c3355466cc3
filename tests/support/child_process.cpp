#include "tests/support/child_process.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

#include "tests/support/scratch_folder.h"

namespace roomwise {
namespace {

[[noreturn]] void become(const std::vector<std::string>& command, const std::string& output_path) {
  const int output = ::open(output_path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  ::execvp(arguments[0], arguments.data());
  ::_exit(127);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command,
                           std::filesystem::path output_path)
    : name_(command.at(0)), output_path_(std::move(output_path)), pid_(::fork()) {
  if (pid_ < 0) throw std::runtime_error("cannot start " + name_);
  if (pid_ == 0) become(command, output_path_.string());
}

ChildProcess::~ChildProcess() {
  if (!is_running()) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, &status_, 0);
}

bool ChildProcess::is_running() {
  if (!ended_) ended_ = ::waitpid(pid_, &status_, WNOHANG) == pid_;
  return !ended_;
}

void ChildProcess::send_signal(int signal) const {
  if (!ended_) ::kill(pid_, signal);
}

int ChildProcess::wait(std::chrono::seconds patience) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (is_running()) {
    if (std::chrono::steady_clock::now() > deadline) {
      throw std::runtime_error(name_ + " is still running; it said:\n" + output());
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
}

std::string ChildProcess::output() const {
  std::ifstream file(output_path_, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

int run_to_end(const std::vector<std::string>& command, std::string& output) {
  ScratchFolder folder;
  ChildProcess process(command, folder.path() / "output");
  const int status = process.wait();
  output = process.output();
  return status;
}

}  // namespace roomwise
