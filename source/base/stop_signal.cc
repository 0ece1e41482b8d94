#include <vibrocontact/base/stop_signal.h>

#include <csignal>

namespace vibrocontact
{
  namespace
  {
    volatile std::sig_atomic_t last_signal = 0;
    /// StopSignals alive
    unsigned int n_listeners = 0;

    extern "C" void keep_signal(const int signal)
    {
      last_signal = signal;
    }

    void handle(const int signal, void (*const handler)(int))
    {
      struct sigaction action = {};
      action.sa_handler = handler;
      action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
      sigaction(signal, &action, nullptr);
    }
  } // namespace

  StopSignals::StopSignals()
  {
    if (n_listeners++ > 0)
      return;
    last_signal = 0;
    for (const int signal : {SIGTERM, SIGINT})
      handle(signal, keep_signal);
  }

  StopSignals::~StopSignals()
  {
    if (--n_listeners > 0)
      return;
    for (const int signal : {SIGTERM, SIGINT})
      handle(signal, SIG_DFL);
  }

  int StopSignals::received() const
  {
    return last_signal;
  }
} // namespace vibrocontact
