// Sequences of random calls of the C interface, without a fuzzer: for any build, and for sanitizers above all.
//
//     couplingCalls                     10000 sequences
//     couplingCalls --count 300 --seed 7
//     couplingCalls --only 1234         one of them, to look at (MPM_FUZZ_SAYS=1 shows what the library says)
#include "fuzz/callSequence.hpp"

#include <csignal>
#include <cstring>
#include <memory>
#include <random>

namespace
{
volatile unsigned long running = 0;

void tell(int)
{
    std::fprintf(stderr, "couplingCalls: in sequence %lu\n", running);
}
} // namespace

int main(int count, char** arguments)
{
    unsigned long number = 10000, seed = 1, only = 0;
    for (int i = 1; i < count; i += 2)
    {
        unsigned long* const option = !std::strcmp(arguments[i], "--count")  ? &number
                                      : !std::strcmp(arguments[i], "--seed") ? &seed
                                      : !std::strcmp(arguments[i], "--only") ? &only
                                                                             : nullptr;
        if (!option || i + 1 == count)
        {
            std::fprintf(stderr, "couplingCalls [--count N] [--seed N] [--only N]\n");
            return 1;
        }
        *option = std::strtoul(arguments[i + 1], nullptr, 10);
    }
    std::signal(SIGABRT, tell);
    const auto sequence = std::make_unique<mpm::fuzz::CallSequence>();
    for (unsigned long i = only ? only : 1; i <= (only ? only : number); ++i)
    {
        std::mt19937_64 engine(seed * 1000003 + i);
        std::vector<std::uint8_t> bytes(16 + engine() % 240);
        for (auto& byte : bytes)
            byte = std::uint8_t(engine());
        running = i;
        if (std::getenv("MPM_FUZZ_SAYS"))
            std::fprintf(stderr, "sequence %lu\n", i);
        sequence->run(bytes.data(), bytes.size());
    }
    std::printf("couplingCalls: %zu calls, %zu granted\n", sequence->calls(), sequence->granted());
    return 0;
}
