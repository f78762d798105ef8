#include <csignal>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "apps/command_line.h"

int main(int argc, char** argv) {
  // A file over the limit of its size is an error of the write that hits it, with a message.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return scattermeter::apps::run_command_line(std::vector<std::string>(argv + 1, argv + argc),
                                                std::cout, std::cerr);
  } catch (const std::exception& e) {
    std::cerr << "scattermeter: internal error: " << e.what() << "\n";
    return 3;
  }
}
