// Sortable records of 16 and 32 bytes, and the sort.
#pragma once

#include "task.h"

namespace sce {
namespace PhysicsEffects {

// Records are looked at as bytes, 16-bit or 32-bit slots. The last 32-bit slot is the key.
template <size_t Bytes>
struct alignas(16) PfxSortDataBytes {
  // The bytes, as slots of three sizes.
  union {
    PfxUInt8 i8data[Bytes];
    PfxUInt16 i16data[Bytes / 2];
    PfxUInt32 i32data[Bytes / 4];
  };
  // The slot of 32 bits that is the key.
  static constexpr size_t kKeySlot = Bytes / 4 - 1;

  // Slots counted from 0; the key is the last one of 32 bits.
  void set8(int slot, PfxUInt8 v) { i8data[slot] = v; }
  void set16(int slot, PfxUInt16 v) { i16data[slot] = v; }
  void set32(int slot, PfxUInt32 v) { i32data[slot] = v; }
  PfxUInt8 get8(int slot) const { return i8data[slot]; }
  PfxUInt16 get16(int slot) const { return i16data[slot]; }
  PfxUInt32 get32(int slot) const { return i32data[slot]; }
  PfxUInt32 key() const { return i32data[kKeySlot]; }
};
// The two sizes.
typedef PfxSortDataBytes<16> PfxSortData16;
typedef PfxSortDataBytes<32> PfxSortData32;
static_assert(sizeof(PfxSortData16) == 16 && sizeof(PfxSortData32) == 32, "records are dense");

// The key that records are sorted by.
inline void pfxSetKey(PfxSortData16& d, PfxUInt32 key) { d.set32(3, key); }
inline void pfxSetKey(PfxSortData32& d, PfxUInt32 key) { d.set32(7, key); }
inline PfxUInt32 pfxGetKey(const PfxSortData16& d) { return d.key(); }
inline PfxUInt32 pfxGetKey(const PfxSortData32& d) { return d.key(); }

// Sorts by key, ascending; equal keys keep their order. `workBuff` is scratch as large as the data, aligned to 16 bytes,
// and holds nothing afterwards.
// SCE_PFX_ERR_INVALID_VALUE: NULL; _INVALID_ALIGN: data or buffer; _OUT_OF_BUFFER: buffer too short. Data are untouched.
PfxInt32 pfxParallelSort(PfxSortData16* data, PfxUInt32 numData, void* workBuff, PfxUInt32 workBytes,
                         PfxTaskManager* taskManager = nullptr);
PfxInt32 pfxParallelSort(PfxSortData32* data, PfxUInt32 numData, void* workBuff, PfxUInt32 workBytes,
                         PfxTaskManager* taskManager = nullptr);

}  // namespace PhysicsEffects
}  // namespace sce
