/* Preloaded into a program under test: makes the Nth call that changes a file below FAULT_FOLDER fail, or kills
 * the process there. Written in C because it replaces functions of the C library.
 *
 *   FAULT_AT=N        number of the call, from 1; 0: only count calls
 *   FAULT_KIND=...    ENOSPC, EIO or EACCES: error of the call; KILL: end the process as kill -9 does
 *   FAULT_COUNT=FILE  receives the number of calls when the program ends normally
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/uio.h>
#include <unistd.h>

static long calls;

static int below_folder(const char* path) {
  const char* folder = getenv("FAULT_FOLDER");
  char real[PATH_MAX];
  if (!folder || !path) return 0;
  if (path[0] != '/') {
    if (!getcwd(real, sizeof real)) return 0;
    return strncmp(real, folder, strlen(folder)) == 0;
  }
  return strncmp(path, folder, strlen(folder)) == 0;
}

static int descriptor_below_folder(int fd) {
  char link[64], path[PATH_MAX];
  snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
  const ssize_t length = readlink(link, path, sizeof path - 1);
  if (length <= 0) return 0;
  path[length] = '\0';
  return below_folder(path);
}

/* True if this call must fail; then errno is set. */
static int strikes(void) {
  const char* at = getenv("FAULT_AT");
  const char* kind = getenv("FAULT_KIND");
  ++calls;
  if (!at || !kind || calls != atol(at)) return 0;
  if (strcmp(kind, "KILL") == 0) kill(getpid(), SIGKILL);
  errno = strcmp(kind, "EIO") == 0 ? EIO : strcmp(kind, "EACCES") == 0 ? EACCES : ENOSPC;
  return 1;
}

__attribute__((destructor)) static void report(void) {
  const char* file = getenv("FAULT_COUNT");
  FILE* out = file ? fopen(file, "w") : NULL;
  if (!out) return;
  fprintf(out, "%ld\n", calls);
  fclose(out);
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

ssize_t write(int fd, const void* data, size_t size) {
  if (fd > 2 && descriptor_below_folder(fd) && strikes()) return -1;
  return REAL(write)(fd, data, size);
}

ssize_t writev(int fd, const struct iovec* parts, int count) {
  if (fd > 2 && descriptor_below_folder(fd) && strikes()) return -1;
  return REAL(writev)(fd, parts, count);
}

int fsync(int fd) {
  if (descriptor_below_folder(fd) && strikes()) return -1;
  return REAL(fsync)(fd);
}

int rename(const char* from, const char* to) {
  if (below_folder(to) && strikes()) return -1;
  return REAL(rename)(from, to);
}

int mkdir(const char* path, mode_t mode) {
  if (below_folder(path) && strikes()) return -1;
  return REAL(mkdir)(path, mode);
}

static int writes(int flags) { return (flags & O_ACCMODE) != O_RDONLY; }

int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & O_CREAT) ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  if (writes(flags) && below_folder(path) && strikes()) return -1;
  return REAL(open)(path, flags, mode);
}

FILE* fopen(const char* path, const char* mode) {
  if (mode[0] != 'r' && below_folder(path) && strikes()) return NULL;
  return REAL(fopen)(path, mode);
}

FILE* fopen64(const char* path, const char* mode) {
  if (mode[0] != 'r' && below_folder(path) && strikes()) return NULL;
  return REAL(fopen64)(path, mode);
}
