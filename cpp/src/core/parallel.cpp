#include "core/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "opacity/core/error.hpp"

namespace opacity {
namespace {

using Work = std::function<void(std::size_t, const std::stop_token&)>;

constexpr std::size_t most_threads = 1024;

// As many as OPACITY_THREADS says, or one a core.
std::size_t usual_threads() {
    const char* variable = std::getenv("OPACITY_THREADS");
    if (!variable || !*variable) return std::max(1u, std::thread::hardware_concurrency());
    char* end = nullptr;
    const unsigned long threads = std::strtoul(variable, &end, 10);
    if (*end || threads < 1 || threads > most_threads)
        throw ParameterError(
            "OPACITY_THREADS=" + std::string{variable} + " is no number of threads",
            "unset it for one a core, or set it to 1.." + std::to_string(most_threads));
    return threads;
}

// Shared by the threads of one call.
class Crew {
   public:
    Crew(std::size_t count, const Work& work) : count_{count}, work_{work} {}

    void help() {
        const std::stop_token stop = stop_.get_token();
        try {
            for (std::size_t i = 0; !stop.stop_requested() && (i = next_++) < count_;) {
                work_(i, stop);
                ++done_;
            }
        } catch (...) {
            stop_.request_stop();
            const std::lock_guard lock{mutex_};
            if (!thrown_) thrown_ = std::current_exception();
        }
        const std::lock_guard lock{mutex_};
        --helpers_;
        changed_.notify_one();
    }
    // Without any thread to be had, the calling one does it all.
    void hire(std::size_t helpers) {
        for (std::size_t i = 0; i < helpers; ++i) {
            ++helpers_;
            try {
                threads_.emplace_back([this] { help(); });
            } catch (const std::system_error&) {
                --helpers_;
                break;
            }
        }
        if (threads_.empty()) {
            ++helpers_;
            help();
        }
    }
    void watch(const std::function<void(double)>& tell) {
        std::unique_lock lock{mutex_};
        const auto idle = [this] { return helpers_ == 0; };
        while (!changed_.wait_for(lock, std::chrono::milliseconds{50}, idle)) {
            lock.unlock();
            tell(double(done_) / double(count_));
            lock.lock();
        }
        if (thrown_) std::rethrow_exception(thrown_);
    }
    ~Crew() { stop_.request_stop(); }  // and the threads are joined

   private:
    const std::size_t count_;
    const Work& work_;
    std::stop_source stop_;
    std::atomic<std::size_t> next_{0}, done_{0}, helpers_{0};
    std::mutex mutex_;
    std::condition_variable changed_;
    std::exception_ptr thrown_;
    std::vector<std::jthread> threads_;  // last: joined before the rest goes
};

}  // namespace

void in_parallel(std::size_t count, int threads, const Work& work,
                 const std::function<void(double)>& watch) {
    const std::size_t most = threads > 0 ? std::size_t(threads) : usual_threads();
    Crew crew{count, work};
    crew.hire(std::min(count, most));
    crew.watch(watch);
}

}  // namespace opacity
