// Preloaded into ripstop by torture.py: counts the calls that change anything below one folder, and at the n-th of them
// fails, or kills the process. Also clocks that go wrong.
//
//     cc -shared -fPIC -O1 -o interpose.so interpose.c -ldl
//
// TORTURE_ROOT   absolute folder whose calls count; without it nothing does
// TORTURE_LOG    file that gets one line a counted call, "n name path"
// TORTURE_AT     number of the call that something happens to, from 1
// TORTURE_DO     what: kill (half of a write is done first), ENOSPC, EIO, short (half of a write, the rest is the
//                caller's), full (half of a write, and no room for the rest)
// TORTURE_BACK   seconds that the time of day goes back with every look at it
// TORTURE_FASTER so many times faster runs the monotonic clock: checkpoints every so many seconds come sooner
//
// Children that the process starts are left alone, whoever they are.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

static char root[4096];
static size_t root_length;
static long at = -1;
static enum { nothing, killed, no_space, io_error, short_write, full_disk } what = nothing;
static int log_file = -1, full_descriptor = -1;
static pid_t self;
static atomic_long counted;
static double back, faster;
static atomic_long looks;
static struct timespec began;

#define REAL(name) ((__typeof__(&name))real(#name))
static void* real(const char* name) {
  return dlsym(RTLD_NEXT, name);
}

__attribute__((constructor)) static void begin(void) {
  if (strncmp(program_invocation_short_name, "ripstop", 7) != 0) return;
  self = getpid();
  if (getenv("TORTURE_BACK")) back = atof(getenv("TORTURE_BACK"));
  REAL(clock_gettime)(CLOCK_MONOTONIC, &began);
  if (getenv("TORTURE_FASTER")) faster = atof(getenv("TORTURE_FASTER"));
  const char* folder = getenv("TORTURE_ROOT");
  if (!folder) return;
  snprintf(root, sizeof root, "%s", folder);
  root_length = strlen(root);
  const char* log = getenv("TORTURE_LOG");
  if (log) log_file = REAL(open)(log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  const char* number = getenv("TORTURE_AT");
  const char* word = getenv("TORTURE_DO");
  if (!number || !word) return;
  at = atol(number);
  what = !strcmp(word, "kill")    ? killed
         : !strcmp(word, "ENOSPC") ? no_space
         : !strcmp(word, "EIO")    ? io_error
         : !strcmp(word, "short")  ? short_write
                                   : full_disk;
}

static int below(const char* path) {
  return root_length && path && !strncmp(path, root, root_length) && (path[root_length] == '/' || !path[root_length]);
}

static const char* path_of(int fd, char* path, size_t size) {
  char link[64];
  snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
  const ssize_t length = readlink(link, path, size - 1);
  path[length < 0 ? 0 : length] = 0;
  return path;
}

static int may_write(int fd) {
  return (fcntl(fd, F_GETFL) & O_ACCMODE) != O_RDONLY;
}

/// Whether this call is the one; -1 is "fail with errno as it is set now".
static int happens(const char* name, const char* path) {
  if (!self || !below(path) || getpid() != self) return 0;
  const long n = ++counted;
  if (log_file >= 0) {
    char line[4400];
    const int length = snprintf(line, sizeof line, "%ld %s %s\n", n, name, path);
    if (REAL(write)(log_file, line, length) != length) abort();
  }
  if (n != at) return 0;
  if (what == no_space || what == io_error) {
    errno = what == no_space ? ENOSPC : EIO;
    return -1;
  }
  return 1;
}

/// Of calls that do not write bytes.
static int fails(const char* name, const char* path) {
  const int now = happens(name, path);
  if (now > 0 && what == killed) kill(self, SIGKILL);
  return now < 0;
}

static int fails_at(const char* name, int folder, const char* path) {
  char whole[8200], above[4096];
  if (path[0] == '/' || folder == AT_FDCWD) return fails(name, path);
  snprintf(whole, sizeof whole, "%s/%s", path_of(folder, above, sizeof above), path);
  return fails(name, whole);
}

#define OPEN(name)                                             \
  int name(const char* path, int flags, ...) {                 \
    va_list list;                                              \
    va_start(list, flags);                                     \
    const mode_t mode = flags & O_CREAT ? va_arg(list, int) : 0; \
    va_end(list);                                              \
    if ((flags & O_ACCMODE) != O_RDONLY && fails("open", path)) return -1; \
    return REAL(name)(path, flags, mode);                      \
  }
OPEN(open)
OPEN(open64)

#define OPENAT(name)                                           \
  int name(int folder, const char* path, int flags, ...) {     \
    va_list list;                                              \
    va_start(list, flags);                                     \
    const mode_t mode = flags & O_CREAT ? va_arg(list, int) : 0; \
    va_end(list);                                              \
    if ((flags & O_ACCMODE) != O_RDONLY && fails_at("open", folder, path)) return -1; \
    return REAL(name)(folder, path, flags, mode);              \
  }
OPENAT(openat)
OPENAT(openat64)

#define FOPEN(name)                                                    \
  FILE* name(const char* restrict path, const char* restrict mode) {   \
    if (mode[0] != 'r' && fails("open", path)) return NULL;            \
    return REAL(name)(path, mode);                                     \
  }
FOPEN(fopen)
FOPEN(fopen64)

/// How many bytes to pass on, -1: none, the call fails.
static ssize_t share(const char* name, int fd, size_t size) {
  char path[4096];
  if (!self || !root_length) return size;
  const int now = happens(name, path_of(fd, path, sizeof path));
  if (now < 0) return -1;
  if (fd == full_descriptor) {
    full_descriptor = -1;
    errno = ENOSPC;
    return -1;
  }
  if (now == 0) return size;
  if (what == full_disk) full_descriptor = fd;
  return size > 1 ? size / 2 : size;
}

static void die_if_due(void) {
  if (self && what == killed && counted == at && getpid() == self) kill(self, SIGKILL);
}

ssize_t write(int fd, const void* bytes, size_t size) {
  const ssize_t part = share("write", fd, size);
  if (part < 0) return -1;
  const ssize_t done = REAL(write)(fd, bytes, part);
  die_if_due();
  return done;
}

#define PWRITE(name, offset_type)                                              \
  ssize_t name(int fd, const void* bytes, size_t size, offset_type offset) {   \
    const ssize_t part = share("write", fd, size);                             \
    if (part < 0) return -1;                                                   \
    const ssize_t done = REAL(name)(fd, bytes, part, offset);                  \
    die_if_due();                                                              \
    return done;                                                               \
  }
PWRITE(pwrite, off_t)
PWRITE(pwrite64, off64_t)

ssize_t writev(int fd, const struct iovec* parts, int count) {
  size_t size = 0;
  for (int i = 0; i < count; ++i) size += parts[i].iov_len;
  const ssize_t part = share("write", fd, size);
  if (part < 0) return -1;
  // Half of many pieces is the first of them.
  const ssize_t done = (size_t)part == size ? REAL(writev)(fd, parts, count) : REAL(writev)(fd, parts, 1);
  die_if_due();
  return done;
}

#define COPY(name, ...)                                          \
  {                                                              \
    const ssize_t part = share("write", out, size);              \
    if (part < 0) return -1;                                     \
    size = part;                                                 \
    const ssize_t done = REAL(name)(__VA_ARGS__);                \
    die_if_due();                                                \
    return done;                                                 \
  }
ssize_t sendfile(int out, int in, off_t* offset, size_t size);
ssize_t sendfile(int out, int in, off_t* offset, size_t size) COPY(sendfile, out, in, offset, size)
ssize_t sendfile64(int out, int in, off64_t* offset, size_t size);
ssize_t sendfile64(int out, int in, off64_t* offset, size_t size) COPY(sendfile64, out, in, offset, size)
ssize_t copy_file_range(int in, off64_t* from, int out, off64_t* to, size_t size, unsigned flags)
    COPY(copy_file_range, in, from, out, to, size, flags)

#define OF_DESCRIPTOR(name)                                                           \
  int name(int fd) {                                                                  \
    char path[4096];                                                                  \
    if (self && root_length && fails(#name, path_of(fd, path, sizeof path))) return -1; \
    return REAL(name)(fd);                                                            \
  }
OF_DESCRIPTOR(fsync)
OF_DESCRIPTOR(fdatasync)

int ftruncate(int fd, off_t size) {
  char path[4096];
  if (self && root_length && fails("ftruncate", path_of(fd, path, sizeof path))) return -1;
  return REAL(ftruncate)(fd, size);
}

int close(int fd) {
  char path[4096];
  const int failed = self && root_length && may_write(fd) && fails("close", path_of(fd, path, sizeof path));
  const int reason = errno, result = REAL(close)(fd);  // a descriptor is gone even when its close fails
  if (!failed) return result;
  errno = reason;
  return -1;
}

int fclose(FILE* file) {
  char path[4096];
  const int fd = fileno(file);
  const int failed =
      self && root_length && fd >= 0 && may_write(fd) && fails("close", path_of(fd, path, sizeof path));
  const int reason = errno, result = REAL(fclose)(file);
  if (!failed) return result;
  errno = reason;
  return EOF;
}

#define OF_PATH(name, declaration, path, ...) \
  int name declaration {                      \
    if (fails(#name, path)) return -1;        \
    return REAL(name)(__VA_ARGS__);           \
  }
OF_PATH(rename, (const char* from, const char* to), to, from, to)
OF_PATH(mkdir, (const char* path, mode_t mode), path, path, mode)
OF_PATH(unlink, (const char* path), path, path)
OF_PATH(rmdir, (const char* path), path, path)
OF_PATH(remove, (const char* path), path, path)

int unlinkat(int folder, const char* path, int flags) {
  if (fails_at("unlinkat", folder, path)) return -1;
  return REAL(unlinkat)(folder, path, flags);
}

int clock_gettime(clockid_t which, struct timespec* now) {
  const int result = REAL(clock_gettime)(which, now);
  if (result != 0 || !self) return result;
  if (which == CLOCK_REALTIME && back > 0) now->tv_sec -= (time_t)(back * (double)++looks);
  if (which == CLOCK_MONOTONIC && faster > 0) {
    const double gone = (now->tv_sec - began.tv_sec + 1e-9 * (now->tv_nsec - began.tv_nsec)) * faster;
    now->tv_sec = began.tv_sec + (time_t)gone;
    now->tv_nsec = (long)(1e9 * (gone - (double)(time_t)gone));
  }
  return result;
}

time_t time(time_t* to) {
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  if (to) *to = now.tv_sec;
  return now.tv_sec;
}
