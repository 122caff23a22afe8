#include "stopping.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cstring>

namespace ripstop::cli {
namespace {

std::atomic<bool> goes_on{false};

/// Only calls that a signal handler may make.
void stopped(int signal_number) {
  const auto say = [](const char* text) {
    [[maybe_unused]] const auto written = write(STDERR_FILENO, text, std::strlen(text));
  };
  say("\nripstop: stopped by ");
  say(signal_number == SIGINT ? "Ctrl-C (SIGINT)" : signal_number == SIGTERM ? "SIGTERM" : "SIGHUP");
  say(goes_on.load() ? "; repeat the same command to resume from the files on disk\n"
                     : "; no incomplete file remains: repeat the same command\n");
  signal(signal_number, SIG_DFL);
  raise(signal_number);
}

}  // namespace

void say_when_stopped() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before = {}, action = {};
    if (sigaction(number, nullptr, &before) != 0 || before.sa_handler == SIG_IGN) continue;
    action.sa_handler = stopped;
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, nullptr);
  }
}

void goes_on_when_repeated() {
  goes_on = true;
}

}  // namespace ripstop::cli
