#include "geometry/silence.hpp"

#include <cstdio>
#include <fcntl.h>
#include <iostream>
#include <unistd.h>

namespace mpm::geometry
{
namespace
{
void flush()
{
    std::cout.flush();
    std::cerr.flush();
    std::fflush(nullptr);
}
} // namespace

Silence::Silence()
{
    flush();
    const int nowhere = ::open("/dev/null", O_WRONLY);
    if (nowhere < 0)
        return;
    for (int fd = 1; fd <= 2; ++fd)
    {
        saved_[fd - 1] = ::dup(fd);
        if (saved_[fd - 1] >= 0)
            ::dup2(nowhere, fd);
    }
    ::close(nowhere);
}

Silence::~Silence()
{
    flush();
    for (int fd = 1; fd <= 2; ++fd)
        if (saved_[fd - 1] >= 0)
        {
            ::dup2(saved_[fd - 1], fd);
            ::close(saved_[fd - 1]);
        }
}
} // namespace mpm::geometry
