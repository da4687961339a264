/* Around the lines of docs/bodies.md: the caller's own objects and drawing. */
#include <hl/hl.h>

void showAngle(double radians);
void useJoints(HLuint door, HLuint latch);

void useJoints(HLuint door, HLuint latch) {
  /* block */
  hlCallObject(latch);
}
