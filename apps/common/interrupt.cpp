// SPDX-License-Identifier: BSD-3-Clause
#include "common/interrupt.h"

#include <csignal>

namespace pcl6d::app {

namespace {
volatile std::sig_atomic_t g_requested = 0;

extern "C" void
onSignal(int signal)
{
  g_requested = 1;
  std::signal(signal, SIG_DFL); // the next one ends the program
}
} // namespace

Interrupt::Interrupt()
{
  g_requested = 0;
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
}

Interrupt::~Interrupt()
{
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool
Interrupt::requested() const
{
  return g_requested != 0;
}

} // namespace pcl6d::app
