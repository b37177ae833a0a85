#include "tools/cli/program_main.h"

#include <exception>
#include <new>
#include <string>

#include "base/error.h"
#include "tools/cli/program.h"
#include "tools/cli/terminal.h"

namespace belvedere::tools {

int program_main(int argc, char** argv) {
  prepare_process();
  const auto fail = [](const std::string& message, ErrorKind kind) {
    print_error("belvedere: " + message + "\n");
    return static_cast<int>(kind);
  };
  try {
    const int status = run_program({argv + (argc > 0 ? 1 : 0), argv + argc});
    finish_output();
    return status;
  } catch (const Error& error) {
    const std::string asked =
        error.kind() == ErrorKind::bug ? "\n  This is a fault of the program, not of your data. Please report it." : "";
    return fail(error.what() + asked, error.kind());
  } catch (const std::bad_alloc&) {
    return fail("there is not enough memory\n  allowed: a smaller output.width and output.height, or a smaller terrain.extent",
                ErrorKind::limit);
  } catch (const std::exception& error) {
    return fail(std::string("unexpected: ") + error.what() + "\n  This is a fault of the program, not of your data. Please report it.",
                ErrorKind::bug);
  } catch (...) {
    return fail("unexpected: an error without a description\n  This is a fault of the program. Please report it.", ErrorKind::bug);
  }
}

}  // namespace belvedere::tools
