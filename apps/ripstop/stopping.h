// Message of the program when it is stopped by Ctrl-C or a signal.
#pragma once

namespace ripstop::cli {

/// From here on SIGINT, SIGTERM and SIGHUP end the program as ever, by the signal, but with a word on standard
/// error. A signal that the caller ignores stays ignored.
void say_when_stopped();
/// The computation that begins now resumes when the same command is repeated.
void goes_on_when_repeated();

}  // namespace ripstop::cli
