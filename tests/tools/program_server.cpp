#include "tests/tools/program_server.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "base/memory/sanitized.h"
#include "tests/counted_memory.h"
#include "tools/cli/program.h"

extern "C" void __gcov_dump() __attribute__((weak));  // there when coverage is measured
// There under the address sanitizer, which would else look for leaks at exit.
extern "C" int __lsan_do_recoverable_leak_check() __attribute__((weak));

namespace belvedere::test {
namespace {

int server = -1;  // the tests' end of the socket
pid_t server_process = -1;

// A message: "run" or "wait", then its fields, each ended by a zero byte.
std::string message_of(const std::vector<std::string>& fields) {
  std::string bytes;
  for (const std::string& field : fields) bytes += field + '\0';
  return bytes;
}

std::vector<std::string> fields_of(const std::string& bytes) {
  std::vector<std::string> fields;
  for (std::size_t at = 0; at < bytes.size(); at += fields.back().size() + 1)
    fields.emplace_back(bytes.c_str() + at);
  return fields;
}

// fields: run, stdout, stderr, number of variables, variables, arguments. Does not return; a thread
// of a library that was there at the fork is not here, so what the library does at exit could wait
// for it: _exit.
[[noreturn]] void run_in_child(const std::vector<std::string>& fields) {
  const auto arguments = fields.begin() + 4 + std::stol(fields[3]);
  std::vector<std::string> variables(fields.begin() + 4, arguments);
  prepare_environment(variables, fields[1], fields[2]);
  std::vector<std::string> words(arguments, fields.end());
  std::vector<char*> argv = {const_cast<char*>("belvedere")};
  for (std::string& word : words) argv.push_back(word.data());
  const int count = static_cast<int>(argv.size());
  argv.push_back(nullptr);
  if (const char* n = std::getenv(failing_allocation)) fail_allocation(std::stoul(n));
  int status = tools::program_main(count, argv.data());
  if (const char* file = std::getenv(allocations_file)) std::ofstream(file) << allocations();
  std::fflush(nullptr);
  std::cout.flush();
  if (__lsan_do_recoverable_leak_check != nullptr && __lsan_do_recoverable_leak_check() != 0)
    status = leak_status;
  if (__gcov_dump != nullptr) __gcov_dump();
  _exit(status);
}

[[noreturn]] void serve(int socket) {
  std::string buffer(1U << 20U, '\0');
  while (true) {
    const ssize_t size = recv(socket, buffer.data(), buffer.size(), 0);
    if (size <= 0) _exit(0);  // the tests are done
    const std::vector<std::string> fields =
        fields_of(buffer.substr(0, static_cast<std::size_t>(size)));
    int answer = 0;
    if (fields[0] == "run") {
      answer = fork();
      if (answer == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        close(socket);
        run_in_child(fields);
      }
    } else {
      waitpid(std::stoi(fields[1]), &answer, 0);
    }
    send(socket, &answer, sizeof answer, MSG_NOSIGNAL);
  }
}

int ask_server(const std::vector<std::string>& fields) {
  const std::string bytes = message_of(fields);
  int answer = 0;
  if (send(server, bytes.data(), bytes.size(), MSG_NOSIGNAL) !=
          static_cast<ssize_t>(bytes.size()) ||
      recv(server, &answer, sizeof answer, 0) != sizeof answer)
    throw std::runtime_error(
        "the server that runs the program has ended, or a command line is too long for it");
  return answer;
}

}  // namespace

void prepare_environment(std::vector<std::string>& variables, const std::string& out,
                         const std::string& err) {
  std::signal(SIGINT, SIG_DFL);  // shells let what runs in the background ignore it, and tests
                                 // interrupt the program
  for (std::string& variable : variables) putenv(variable.data());
  dup2(open(out.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600), STDOUT_FILENO);
  dup2(open(err.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600), STDERR_FILENO);
}

void start_program_server() {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) return;
  const int large = 1 << 20;
  setsockopt(ends[0], SOL_SOCKET, SO_SNDBUF, &large, sizeof large);
  const pid_t child = fork();
  if (child < 0) return;
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // the tests end, and with them their child processes
    std::signal(SIGINT, SIG_IGN);      // from the terminal: the tests end
    close(ends[0]);
    serve(ends[1]);
  }
  close(ends[1]);
  server = ends[0];
  server_process = child;
}

void stop_program_server() {
  if (server < 0) return;
  close(server);
  waitpid(server_process, nullptr, 0);
}

bool has_program_server() {
#ifdef BELVEDERE_SANITIZED
  return false;
#else
  return server >= 0;
#endif
}

int start_in_server(const std::vector<std::string>& arguments,
                    const std::vector<std::string>& environment, const std::string& out,
                    const std::string& err) {
  std::vector<std::string> fields = {"run", out, err, std::to_string(environment.size())};
  fields.insert(fields.end(), environment.begin(), environment.end());
  fields.insert(fields.end(), arguments.begin(), arguments.end());
  return ask_server(fields);
}

int wait_in_server(int child) { return ask_server({"wait", std::to_string(child)}); }

}  // namespace belvedere::test
