// SPDX-License-Identifier: MIT
// Long work without Python's lock: other threads of Python run on, progress is told, Ctrl-C is heard.
#pragma once
#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <mutex>
#include <string>
#include <utility>

namespace shakedown {

/// How far the work is; written by any thread.
class ToldProgress {
 public:
  /// Notes what is being done, and which share of it is, 0 to 1.
  void tell(const std::string& stage, double fraction) {
    const std::lock_guard lock(mutex_);
    stage_ = stage, fraction_ = fraction, fresh_ = true;
  }
  /// Hands what is new to Python; `listener` takes stage and fraction, or is None.
  void hand_to(const pybind11::object& listener) {
    std::string stage;
    double fraction = 0;
    {
      const std::lock_guard lock(mutex_);
      if (!std::exchange(fresh_, false)) return;
      stage = stage_, fraction = fraction_;
    }
    if (!listener.is_none()) listener(stage, fraction);
  }

 private:
  std::mutex mutex_;
  std::string stage_;
  double fraction_ = 0;
  bool fresh_ = false;
};

/// Returns the result of `work(ToldProgress&, const std::atomic<bool>* stop)`, done in a thread of its own
/// while this one looks after Python: ten times a second it tells the progress and takes signals. An
/// exception of the listener or of a signal (KeyboardInterrupt) stops the work and goes on from here.
template <class Work>
auto released(const pybind11::object& listener, Work work) {
  std::atomic<bool> stop = false;
  ToldProgress told;
  auto done = std::async(std::launch::async, [&] { return work(told, &stop); });
  std::exception_ptr raised;
  for (bool ready = false; !ready;) {
    {
      const pybind11::gil_scoped_release free;
      ready = done.wait_for(std::chrono::milliseconds(raised ? 1000 : 100)) == std::future_status::ready;
    }
    if (raised) continue;
    try {
      if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
      told.hand_to(listener);
    } catch (...) {
      raised = std::current_exception();
      stop = true;
    }
  }
  if (raised) std::rethrow_exception(raised);
  return done.get();
}

}  // namespace shakedown
