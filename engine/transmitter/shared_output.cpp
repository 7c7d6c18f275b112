#include "engine/transmitter/shared_output.h"

#include <sys/mman.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <new>

#include "engine/base/error.h"

namespace helical {

TimeNs systemTime() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kNanosecondsPerSecond + now.tv_nsec;
}

SharedOutputMapping::SharedOutputMapping() : descriptor_(memfd_create("helical-output", MFD_CLOEXEC)) {
  if (descriptor_ < 0 || ftruncate(descriptor_, sizeof(SharedOutput)) != 0)
    throw Error(ErrorKind::kSystem,
                std::string("no memory to share with the output process: ") + std::strerror(errno), {},
                "free some memory");
  map();
  new (shared_) SharedOutput;
}

SharedOutputMapping::SharedOutputMapping(int descriptor) : descriptor_(descriptor) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0 || static_cast<std::size_t>(status.st_size) != sizeof(SharedOutput))
    throw Error(ErrorKind::kInput, "this is not the memory of a ground station", {},
                "helical starts this program by itself; both must be of one build");
  map();
  if (shared_->version != SharedOutput::kVersion)
    throw Error(ErrorKind::kInput, "the ground station is of another version", {},
                "use programs of one build");
}

void SharedOutputMapping::map() {
  void* memory = mmap(nullptr, sizeof(SharedOutput), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor_, 0);
  if (memory == MAP_FAILED)
    throw Error(ErrorKind::kSystem, std::string("memory cannot be shared: ") + std::strerror(errno), {},
                "free some memory");
  shared_ = static_cast<SharedOutput*>(memory);
}

SharedOutputMapping::~SharedOutputMapping() {
  munmap(shared_, sizeof(SharedOutput));
  close(descriptor_);
}

}  // namespace helical
