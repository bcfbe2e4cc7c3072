// Task managers of the overview's API, over the engine's pool of workers.
#pragma once

#include "base.h"

// Loading of console modules: nothing to do here. Templates, so that a program may bring functions of its own.
enum { SCE_SYSMODULE_ULT = 0x0022 };
// Does nothing; 0.
template <class Module>
inline int sceSysmoduleLoadModule(Module) {
  return 0;
}
// Does nothing; 0.
template <class Module>
inline int sceSysmoduleUnloadModule(Module) {
  return 0;
}

namespace sce {
namespace PhysicsEffects {

// A pool of threads. Every stage takes one as its last argument; the results are the same with and without.
class PfxTaskManager {
 public:
  // `workBuff`: getWorkBytes(maxTasks) bytes, aligned to 16, valid until after finalize().
  PfxTaskManager(PfxUInt32 numTasks, PfxUInt32 maxTasks, void* workBuff, PfxUInt32 workBytes);
  // Stops the threads.
  virtual ~PfxTaskManager();
  PfxTaskManager(const PfxTaskManager&) = delete;
  PfxTaskManager& operator=(const PfxTaskManager&) = delete;

  // Bytes of the buffer.
  static PfxUInt32 getWorkBytes(PfxUInt32 maxTasks);

  // Starts the threads. SCE_PFX_ERR_INVALID_VALUE: buffer NULL or no task; _INVALID_ALIGN, _OUT_OF_BUFFER: see above.
  // Until it has succeeded every stage runs on the calling thread.
  virtual PfxInt32 initialize();
  // Stops the threads. Safe to repeat.
  virtual PfxInt32 finalize();

  // Threads in use, the caller included, and the most that there may be.
  PfxUInt32 getNumTasks() const { return num_tasks_; }
  PfxUInt32 getMaxTasks() const { return max_tasks_; }
  // Takes effect at the next initialize(); at most getMaxTasks().
  void setNumTasks(PfxUInt32 numTasks) { num_tasks_ = SCE_PFX_CLAMP(numTasks, 1u, max_tasks_); }
  // Whether the threads run; the pool is for the stages.
  bool isInitialized() const { return pool_ != nullptr; }
  void* getPool() const { return pool_; }

 private:
  PfxUInt32 num_tasks_, max_tasks_, work_bytes_;
  void* work_buff_;
  void* pool_ = nullptr;  // the engine's task manager, in the work buffer
};

// The console's name for it.
class PfxPsp2TaskManager : public PfxTaskManager {
 public:
  using PfxTaskManager::PfxTaskManager;
};

}  // namespace PhysicsEffects
}  // namespace sce
