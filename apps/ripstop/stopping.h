// What the program says when it is stopped by Ctrl-C or a signal.
#pragma once

namespace ripstop {

/// From here on SIGINT, SIGTERM and SIGHUP end the program as ever, by the signal, but with a word on standard
/// error. A signal that the caller ignores stays ignored.
void say_when_stopped();
/// What is begun now goes on where it was when the same command is given again.
void goes_on_when_repeated();

}  // namespace ripstop
