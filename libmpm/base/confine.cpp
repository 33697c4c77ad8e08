#include "base/confine.hpp"

#include "base/memory.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <sys/resource.h>
#include <unistd.h>
#include <vector>
#if defined(__linux__) && (defined(__x86_64__) || defined(__aarch64__))
#define MPM_SECCOMP
#include <cerrno>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define MPM_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define MPM_SANITIZED
#endif
#endif

namespace mpm
{
namespace
{
void limit(int what, rlim_t most)
{
    rlimit now{};
    if (::getrlimit(what, &now) != 0)
        return;
    now.rlim_max = now.rlim_max == RLIM_INFINITY || most < now.rlim_max ? most : now.rlim_max;
    now.rlim_cur = now.rlim_max;
    ::setrlimit(what, &now);
}

#ifdef MPM_SECCOMP
constexpr unsigned architecture =
#ifdef __x86_64__
    AUDIT_ARCH_X86_64;
#else
    AUDIT_ARCH_AARCH64;
#endif

constexpr long refusedCalls[] = {
#ifdef __x86_64__
    SYS_creat,         SYS_fork,        SYS_vfork,        SYS_unlink,
    SYS_rename,        SYS_mkdir,       SYS_rmdir,        SYS_link,
    SYS_symlink,       SYS_mknod,       SYS_chmod,        SYS_chown,
    SYS_lchown,        SYS_utime,       SYS_utimes,       SYS_futimesat,
    SYS_renameat,
#endif
    SYS_execve,        SYS_execveat,    SYS_unlinkat,     SYS_renameat2,
    SYS_mkdirat,       SYS_linkat,      SYS_symlinkat,    SYS_mknodat,
    SYS_truncate,      SYS_fchmod,      SYS_fchmodat,     SYS_fchown,
    SYS_fchownat,      SYS_utimensat,   SYS_setxattr,     SYS_lsetxattr,
    SYS_fsetxattr,     SYS_removexattr, SYS_lremovexattr, SYS_fremovexattr,
    SYS_socket,        SYS_socketpair,  SYS_kill,         SYS_ptrace,
    SYS_mount,         SYS_umount2,     SYS_chroot,       SYS_process_vm_writev,
    SYS_io_uring_setup};

bool filterCalls()
{
    const auto refusal = [](int error) {
        return sock_filter BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | unsigned(error));
    };
    const sock_filter allow = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
    const auto load = [](std::size_t offset) {
        return sock_filter BPF_STMT(BPF_LD | BPF_W | BPF_ABS, unsigned(offset));
    };
    const auto unlessEqual = [](unsigned value, unsigned char skip) {
        return sock_filter BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 0, skip);
    };
    const auto argument = [&](int k) { return load(offsetof(seccomp_data, args) + 8 * std::size_t(k)); };
    std::vector<sock_filter> program = {
        load(offsetof(seccomp_data, arch)), BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, architecture, 1, 0), refusal(EPERM),
        load(offsetof(seccomp_data, nr)),   BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, 0x40000000u, 0, 1),  refusal(EPERM)};
    const auto add = [&](std::initializer_list<sock_filter> more) { program.insert(program.end(), more); };
    for (const long call : refusedCalls)
        add({unlessEqual(unsigned(call), 1), refusal(EPERM)});
    constexpr unsigned writing = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC, thread = 0x10000; // CLONE_THREAD
    const auto refuseIf = [&](long call, int where, unsigned bits, bool set) {
        const unsigned char yes = set ? 0 : 1, no = set ? 1 : 0;
        add({unlessEqual(unsigned(call), 4), argument(where), BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, bits, yes, no),
             refusal(EPERM), allow});
    };
#ifdef SYS_open
    refuseIf(SYS_open, 1, writing, true);
#endif
    refuseIf(SYS_openat, 2, writing, true);
    refuseIf(SYS_clone, 0, thread, false);
    add({unlessEqual(unsigned(SYS_clone3), 1), refusal(ENOSYS)}); // the C library then asks for clone
    add({unlessEqual(437 /* openat2 */, 1), refusal(ENOSYS)});
    program.push_back(allow);
    const sock_fprog whole{static_cast<unsigned short>(program.size()), program.data()};
    return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &whole) == 0;
}
#else
bool filterCalls()
{
    return false;
}
#endif
} // namespace

bool confineProcess([[maybe_unused]] double moreMemory)
{
    std::signal(SIGXFSZ, SIG_IGN); // writing fails with EFBIG instead
    limit(RLIMIT_FSIZE, 0);
    limit(RLIMIT_CORE, 0);
#ifndef MPM_SANITIZED // which map terabytes they never touch
    if (const double bytes = std::min(machineMemory(), dataMemory() + moreMemory); std::isfinite(bytes))
        limit(RLIMIT_DATA, rlim_t(bytes));
#endif
    return filterCalls();
}
} // namespace mpm
