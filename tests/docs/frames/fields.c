/* Around the lines of docs/fields.md: the caller's own number. */
#include <hl/hl.h>

void useFields(HLuint guide);

void useFields(HLuint guide) {
  /* block */
  hlFlush();
}
