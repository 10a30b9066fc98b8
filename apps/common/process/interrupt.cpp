// SPDX-License-Identifier: BSD-3-Clause
#include "common/process/interrupt.h"

namespace pcl6d::app {

namespace {
volatile std::sig_atomic_t g_requested = 0;

extern "C" void
onSignal(int)
{
  g_requested = 1;
}
} // namespace

Interrupt::Interrupt()
{
  g_requested = 0;
  struct sigaction action {};
  action.sa_handler = onSignal;
  // a second signal ends the process
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN)
      ::sigaction(kSignals[i], &action, nullptr);
  }
}

Interrupt::~Interrupt()
{
  for (std::size_t i = 0; i < kSignals.size(); ++i)
    ::sigaction(kSignals[i], &before_[i], nullptr);
}

bool
Interrupt::requested() const
{
  return g_requested != 0;
}

} // namespace pcl6d::app
