#pragma once

#include <string>
#include <vector>

// Runs the program without the cost of starting a process: loading its 265 shared libraries takes
// 0.3 to 0.6 CPU seconds, longer than what is tested. A server process is forked before the tests
// begin; for each run it forks a child that calls the program's main function. So every run starts
// in the state of a new process, without threads or open files of the tests.
namespace belvedere::test {

// In main, before there are threads. Under sanitizers tests use processes of their own all the
// same, unless they need something of this one.
void start_program_server();
void stop_program_server();
bool has_program_server();

// Variables of a run: the allocation that fails, counted from 1, and a file for their number.
inline constexpr const char* failing_allocation = "BELVEDERE_TEST_FAILING_ALLOCATION";
inline constexpr const char* allocations_file = "BELVEDERE_TEST_ALLOCATIONS";
inline constexpr int leak_status = 99;  // exit status of a run that leaks, under a sanitizer

// In a child that becomes the program: stdout and stderr go to files, `variables` ("NAME=value")
// are added; they must live on.
void prepare_environment(std::vector<std::string>& variables, const std::string& out,
                         const std::string& err);

// Starts the program in such an environment.
int start_in_server(const std::vector<std::string>& arguments,
                    const std::vector<std::string>& environment, const std::string& out,
                    const std::string& err);
// Waits for a program that start_in_server started; its status as waitpid gives it.
int wait_in_server(int child);

}  // namespace belvedere::test
