/* Around the lines of docs/snaps.md: the caller's own number. */
#include <hl/hl.h>

void useSnaps(HLuint guide);

void useSnaps(HLuint guide) {
  /* block */
  hlCallObject((HLuint)(object + number));
}
