#pragma once
/// Being asked to stop: SIGINT (Ctrl-C), SIGTERM (kill, batch systems), SIGHUP (the terminal is gone).
///
/// While an Interruption stands, the first of them is only noted: the program looks at signal() where it can end well.
/// The next one, of whichever kind, kills at once. A signal that was ignored when the program began stays ignored
/// (nohup, shells that start it in the background). The destructor puts back what was there before.
///
///     const Interruption interruption;
///     while (!run.done() && !interruption.signal())
///         run.step();
///
/// Who ends that way exits with 128 + signal (130, 143, 129), as shells say it of a killed program.
#include <string>

namespace mpm::cases
{
/// One at a time in a program.
class Interruption
{
  public:
    Interruption();
    ~Interruption();
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;

    /// Number of the signal that came; 0 if none did.
    int signal() const;
    static int exitCode(int signal) { return 128 + signal; }
};

/// "SIGINT", "SIGTERM", "SIGHUP".
std::string signalName(int signal);
} // namespace mpm::cases
