// SPDX-License-Identifier: MIT
#pragma once
#include <functional>

namespace shakedown {

/// Returns the number of threads to use: `threads`, or one for each core when the user names none (0).
int threads_or_all(int threads);

/// Calls `serve`, which must throw nothing, on so many threads at once, the caller's among them, and returns
/// when all calls have.
void serve_on_threads(int threads, const std::function<void()>& serve);

/// Calls work(0) ... work(count - 1), several at a time on `threads` threads (the caller's is one of them).
/// What each call returns is then called one at a time in ascending order: the receiver of the results sees
/// the order of one thread, whatever the number of threads. No more results than 16 a thread wait in memory.
/// When one throws, no more are begun and the exception of the lowest number is thrown on, after everything
/// below it was delivered.
void work_in_parallel_deliver_in_order(int count, int threads,
                                       const std::function<std::function<void()>(int)>& work);

}  // namespace shakedown
