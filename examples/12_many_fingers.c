/* A thousand fingers at once: each goes down onto the teapot, and a map of heights and forces comes out.
 * Built with -lhlbatch. */
#include <hl/hl_batch.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { kSide = 32, kFingers = kSide * kSide, kSteps = 120 };

static double positions[kFingers][3], proxies[kFingers][3], forces[kFingers][3];
static HLint contacts[kFingers];

int main(void) {
  HLbatchScene* scene = hlBatchLoadScene("teapot", 0.1);
  if (scene == NULL) {
    fprintf(stderr, "%s\n", hlBatchError());
    return 1;
  }
  double low[3], high[3];
  hlBatchSceneBounds(scene, low, high);

  HLbatchSettings settings;
  hlBatchSettings(&settings);
  settings.radius = 0.001;
  hlBatchSurface(&settings, HL_STATIC_FRICTION, 0.3);
  hlBatchSurface(&settings, HL_DYNAMIC_FRICTION, 0.2);
  HLbatchFingers* fingers = hlBatchMakeFingers(scene, &settings, kFingers);
  if (fingers == NULL) {
    fprintf(stderr, "%s\n", hlBatchError());
    return 1;
  }

  const HLbatchResult result = {&proxies[0][0], &forces[0][0], contacts, NULL};
  for (int step = 0; step < kSteps; ++step) {
    for (int i = 0; i < kFingers; ++i) {
      positions[i][0] = low[0] + (high[0] - low[0]) * (i % kSide + 0.5) / kSide;
      positions[i][1] = high[1] + 0.005 - 0.001 * step;
      positions[i][2] = low[2] + (high[2] - low[2]) * (i / kSide + 0.5) / kSide;
    }
    if (hlBatchStep(fingers, &positions[0][0], 0, &result) != HL_NO_ERROR) {
      fprintf(stderr, "%s\n", hlBatchError());
      return 1;
    }
  }

  int touching = 0;
  double largest = 0;
  for (int i = 0; i < kFingers; ++i) {
    const double* f = forces[i];
    touching += contacts[i] > 0;
    largest = fmax(largest, sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]));
  }
  printf("of %d fingers %d touch; the largest force is %.1f N\n", kFingers, touching, largest);
  for (int z = 0; z < kSide; z += 2) {
    for (int x = 0; x < kSide; ++x) {
      const int i = z * kSide + x;
      const double part = (proxies[i][1] - low[1]) / (high[1] - low[1]);
      putchar(contacts[i] > 0 ? " .:-=+*#%@"[(int)(9.99 * fmin(fmax(part, 0), 1))] : ' ');
    }
    putchar('\n');
  }
  hlBatchDeleteFingers(fingers);
  hlBatchDeleteScene(scene);
  return 0;
}
