// Bytes as a sequence of calls of the C interface.
#include "fuzz/callSequence.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static mpm::fuzz::CallSequence sequence;
    sequence.run(data, size);
    return 0;
}
