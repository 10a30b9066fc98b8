// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <set>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace pcl6d::test {

/** \return the calls to the system that change what is on a disk, or make it last */
inline const std::set<long>&
diskCalls()
{
  static const std::set<long> calls{SYS_renameat2,
                                    SYS_fsync,
                                    SYS_fdatasync,
                                    SYS_linkat,
                                    SYS_unlinkat,
                                    SYS_fchmod,
                                    SYS_fchmodat,
                                    SYS_mkdirat,
                                    SYS_ftruncate,
                                    SYS_fchown,
                                    SYS_fchownat,
#ifdef SYS_rename
                                    SYS_rename,
                                    SYS_link,
                                    SYS_unlink,
                                    SYS_rmdir,
                                    SYS_mkdir,
                                    SYS_chmod,
                                    SYS_lchown,
#endif
                                    SYS_renameat};
  return calls;
}

/** \brief From now on a call to the system fails in this process, as where it is not known.
 * \return whether that can be had */
inline bool
makeUnknown(long call)
{
  sock_filter words[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned int>(call), 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOSYS),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
  sock_fprog program{sizeof words / sizeof *words, words};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

/** \brief Does something in a process of its own, which is killed just before its n-th call
 * that changes the disk. \param[in] n from 1
 * \return whether there were so many; false: it has done all \throws nothing; a process that
 * fails in another way aborts the test */
inline bool
killedAtDiskCall(int n, const std::function<void()>& work)
{
  const pid_t child = ::fork();
  if (child == 0) {
    ::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
    ::raise(SIGSTOP);
    try {
      work();
    } catch (...) {
      ::_exit(1);
    }
    ::_exit(0);
  }
  int status = 0, seen = 0;
  ::waitpid(child, &status, 0);
  ::ptrace(
      PTRACE_SETOPTIONS, child, nullptr, PTRACE_O_TRACESYSGOOD | PTRACE_O_EXITKILL);
  while (true) {
    ::ptrace(PTRACE_SYSCALL, child, nullptr, nullptr);
    if (::waitpid(child, &status, 0) != child)
      std::abort();
    if (WIFEXITED(status) || WIFSIGNALED(status))
      break;
    __ptrace_syscall_info info{};
    if (!WIFSTOPPED(status) || WSTOPSIG(status) != (SIGTRAP | 0x80) ||
        ::ptrace(PTRACE_GET_SYSCALL_INFO, child, sizeof info, &info) <= 0 ||
        info.op != PTRACE_SYSCALL_INFO_ENTRY)
      continue;
    if (diskCalls().count(static_cast<long>(info.entry.nr)) > 0 && ++seen == n) {
      ::kill(child, SIGKILL);
      ::waitpid(child, &status, 0);
      return true;
    }
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    std::abort();
  return false;
}

} // namespace pcl6d::test
