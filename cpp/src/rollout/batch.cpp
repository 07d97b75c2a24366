// Workers draw the indices of runs from a counter; each has a Stepper and scratch of its own and
// writes to the rows of its run, so that which of them makes a run leaves no trace. The thread that
// called makes no run: it waits, tells the progress, and is interrupted.
#include "saltus/rollout/batch.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>

#include "rollout/batch_storage.hpp"
#include "saltus/model/check_derivatives.hpp"

namespace saltus {
namespace {

/// Two lines of a cache: what one thread writes often shares none with what another reads.
constexpr std::size_t line = 128;

/// The error with the run's index before its message.
[[noreturn]] void rethrow_for_run(const std::exception_ptr& error, long index) {
  const std::string run = "run " + std::to_string(index) + ": ";
  try {
    std::rethrow_exception(error);
  } catch (const JammedError& e) {
    throw JammedError(run + e.what(), e.t, e.residual, e.iterations);
  } catch (const StepError& e) {
    throw StepError(run + e.what(), e.t, e.residual, e.iterations);
  } catch (const ModelError& e) {
    throw ModelError(run + e.what(), e.element, e.name);
  }
}

class Crew {
 public:
  Crew(const Plan& plan, std::span<const State> starts, const BatchOptions& options,
       BatchTrajectory& out)
      : plan_(plan),
        starts_(starts),
        options_(options),
        on_failure_(options.on_failure),
        out_(out),
        first_failed_(static_cast<long>(starts.size())) {}
  ~Crew() {
    stop_ = true;
    for (std::thread& thread : threads_) thread.join();
  }
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  void start(int threads);
  void wait(const std::function<bool(double)>& progress);
  bool stopped() const { return stop_; }

 private:
  struct alignas(line) Worker {
    std::atomic<long> steps = 0;  ///< done, in all of its runs
  };

  void work(Worker& me);
  void make_run(long i, Stepper& stepper, EnergyMeter& meter, Worker& me);
  void fail_run(long i);
  void give_up(std::exception_ptr error);
  double part_done() const;

  const Plan& plan_;
  const std::span<const State> starts_;
  const BatchOptions& options_;
  const OnFailure on_failure_;
  BatchTrajectory& out_;
  std::vector<std::unique_ptr<Worker>> workers_;
  std::vector<std::thread> threads_;

  std::mutex mutex_;
  std::condition_variable one_left_;
  int working_ = 0;              // by mutex_
  std::exception_ptr failure_;   // by mutex_: of first_failed_
  std::exception_ptr accident_;  // by mutex_: no run's own, such as std::bad_alloc

  alignas(line) std::atomic<long> next_ = 0;
  alignas(line) std::atomic<bool> stop_ = false;  // read before every step, written once
  std::atomic<long> first_failed_;                // likewise; the number of runs if none stops them
};

/// As many as the machine gives, but one at least.
void Crew::start(int threads) {
  for (int i = 0; i < threads; ++i) workers_.push_back(std::make_unique<Worker>());
  for (int i = 0; i < threads; ++i) {
    const std::lock_guard lock(mutex_);
    try {
      threads_.emplace_back(&Crew::work, this, std::ref(*workers_[i]));
    } catch (const std::system_error&) {
      if (threads_.empty()) throw;
      break;
    }
    ++working_;
  }
}

void Crew::work(Worker& me) {
  try {
    Stepper stepper(out_.model, plan_.step);
    EnergyMeter meter(*out_.model);
    for (long i = next_++; i < first_failed_ && !stop_; i = next_++) {
      make_run(i, stepper, meter, me);
    }
  } catch (...) {
    give_up(std::current_exception());
  }
  const std::lock_guard lock(mutex_);
  --working_;
  one_left_.notify_one();
}

// Where failures stop the batch, runs before the failed one go on: one of them may fail as well,
// and the error thrown is that of the first by index, whichever came first in time.
void Crew::make_run(long i, Stepper& stepper, EnergyMeter& meter, Worker& me) {
  const long before = me.steps;
  const auto go_on = [&](long k) {
    me.steps.store(before + k, std::memory_order_relaxed);
    return !stop_.load(std::memory_order_relaxed) &&
           i < first_failed_.load(std::memory_order_relaxed);
  };
  RunOutcome outcome;  // moved at the end: neighbours in out_.outcome are other threads'
  try {
    const bool has_own = !options_.policies.empty();
    const Policy& policy =
        has_own ? options_.policies[static_cast<std::size_t>(i)] : options_.run.policy;
    run(out_.model, plan_, starts_[i], go_on, policy, stepper, meter, rows_of(out_, i), outcome);
  } catch (const std::bad_alloc&) {
    throw;                                 // no run's own
  } catch (const std::exception& error) {  // of ours, or of what a user's function threw
    outcome.failure = error.what();
    fail_run(i);
  }
  out_.outcome[i] = std::move(outcome);
  me.steps = before + plan_.steps;  // a run that failed is done as well
}

/// Called where the run's exception is being handled.
void Crew::fail_run(long i) {
  if (on_failure_ == OnFailure::go_on) return;
  const std::lock_guard lock(mutex_);
  if (i >= first_failed_) return;
  first_failed_ = i;
  failure_ = std::current_exception();
}

void Crew::give_up(std::exception_ptr error) {
  const std::lock_guard lock(mutex_);
  accident_ = std::move(error);
  stop_ = true;
}

double Crew::part_done() const {
  double steps = 0;
  for (const auto& worker : workers_) {
    steps += static_cast<double>(worker->steps.load(std::memory_order_relaxed));
  }
  return steps / static_cast<double>(plan_.steps) / static_cast<double>(starts_.size());
}

void Crew::wait(const std::function<bool(double)>& progress) {
  const auto nobody_works = [&] { return working_ == 0; };
  std::unique_lock lock(mutex_);
  while (!one_left_.wait_for(lock, std::chrono::milliseconds(100), nobody_works)) {
    if (!progress || stop_) continue;
    lock.unlock();
    if (!progress(std::min(part_done(), 1.0))) stop_ = true;
    lock.lock();
  }
  if (accident_) std::rethrow_exception(accident_);
  if (failure_) rethrow_for_run(failure_, first_failed_);
}

int count_threads(int asked, std::size_t runs) {
  if (asked < 0) {
    throw ModelError("threads = " + std::to_string(asked) +
                     "; it must be at least 1, or 0 for all that the machine runs at once");
  }
  const auto most = static_cast<int>(std::min<std::size_t>(runs, 1 << 12));
  const int all = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return std::min(asked == 0 ? all : asked, most);
}

}  // namespace

BatchTrajectory simulate_batch(const Model& model, std::span<const State> starts, double duration,
                               const BatchOptions& options) {
  BatchTrajectory out{.model = model};
  simulate_batch(model, starts, duration, options, out);
  return out;
}

void simulate_batch(const Model& model, std::span<const State> starts, double duration,
                    const BatchOptions& options, BatchTrajectory& out) {
  Plan plan = make_plan(duration, options.run);
  const int threads = count_threads(options.threads, starts.size());
  check_starts(model, starts);
  if (!options.policies.empty() && options.policies.size() != starts.size()) {
    throw ModelError("controls of " + std::to_string(options.policies.size()) + " runs, and " +
                     std::to_string(starts.size()) + " starts");
  }
  check_memory(model, plan, static_cast<Eigen::Index>(starts.size()));
  Stepper(model, plan.step);  // refuses its options here and not in a thread
  if (!starts.empty()) check_derivatives_once(model, starts[0].q, starts[0].t);  // likewise
  out = empty_batch(model, plan, starts);
  Crew crew(plan, starts, options, out);
  crew.start(threads);
  crew.wait(options.run.progress);
  if (options.run.progress && !crew.stopped()) options.run.progress(1);
}

}  // namespace saltus
