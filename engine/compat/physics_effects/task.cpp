#include "compat/physics_effects/task.h"

#include <new>

#include "compat/physics_effects/native.h"
#include "compat/physics_effects/sort.h"
#include "pfx/low_level/sort/radix_sort.h"

namespace sce::PhysicsEffects {
namespace {

template <class Record>
PfxInt32 sortRecords(Record* data, PfxUInt32 count, void* work, PfxUInt32 work_bytes, PfxTaskManager* tasks) {
  if (count == 0) return SCE_PFX_OK;
  if (data == nullptr || work == nullptr) return SCE_PFX_ERR_INVALID_VALUE;
  if (!aligned16(data) || !aligned16(work)) return SCE_PFX_ERR_INVALID_ALIGN;
  if (work_bytes / sizeof(Record) < count) return SCE_PFX_ERR_OUT_OF_BUFFER;
  const std::span<Record> records(data, count), scratch(static_cast<Record*>(work), count);
  return errorCode(pfx::sort(records, scratch, poolOf(tasks)));
}

}  // namespace

PfxTaskManager::PfxTaskManager(PfxUInt32 numTasks, PfxUInt32 maxTasks, void* workBuff, PfxUInt32 workBytes)
    : num_tasks_(SCE_PFX_MIN(numTasks, maxTasks)), max_tasks_(maxTasks), work_bytes_(workBytes), work_buff_(workBuff) {}

PfxTaskManager::~PfxTaskManager() { finalize(); }

PfxUInt32 PfxTaskManager::getWorkBytes(PfxUInt32) { return SCE_PFX_BYTES_ALIGN16(sizeof(pfx::TaskManager)); }

PfxInt32 PfxTaskManager::initialize() {
  if (work_buff_ == nullptr || num_tasks_ == 0) return SCE_PFX_ERR_INVALID_VALUE;
  if (!aligned16(work_buff_)) return SCE_PFX_ERR_INVALID_ALIGN;
  if (work_bytes_ < getWorkBytes(max_tasks_)) return SCE_PFX_ERR_OUT_OF_BUFFER;
  finalize();
  pool_ = new (work_buff_) pfx::TaskManager(static_cast<int>(SCE_PFX_MIN(num_tasks_, 64u)));
  return SCE_PFX_OK;
}

PfxInt32 PfxTaskManager::finalize() {
  if (pool_ != nullptr) static_cast<pfx::TaskManager*>(pool_)->~TaskManager();
  pool_ = nullptr;
  return SCE_PFX_OK;
}

PfxInt32 pfxParallelSort(PfxSortData16* data, PfxUInt32 numData, void* workBuff, PfxUInt32 workBytes,
                         PfxTaskManager* taskManager) {
  return sortRecords(data, numData, workBuff, workBytes, taskManager);
}
PfxInt32 pfxParallelSort(PfxSortData32* data, PfxUInt32 numData, void* workBuff, PfxUInt32 workBytes,
                         PfxTaskManager* taskManager) {
  return sortRecords(data, numData, workBuff, workBytes, taskManager);
}

}  // namespace sce::PhysicsEffects
