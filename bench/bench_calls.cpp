// What the HL calls cost the application: a vertex is to cost a few nanoseconds, however the mesh is drawn.
#include <benchmark/benchmark.h>
#include <hl/hl.h>

#include <cstddef>
#include <memory>
#include <vector>

#include "client/open_link.h"

namespace hl::client {
namespace {

// A server that welcomes and forgets what it is sent.
class ForgetfulLink : public Link {
 public:
  void send(proto::ClientMessage message) override { benchmark::DoNotOptimize(message); }
  std::size_t queuedBytes() const override { return 0; }
  bool take(proto::ServerReply& reply) override {
    if (welcomed_) return false;
    welcomed_ = true;
    reply.mutable_welcome()->set_protocol_version(1);
    return true;
  }
  bool wait(std::chrono::nanoseconds) override { return false; }
  std::string ended() const override { return ""; }

 private:
  bool welcomed_ = false;
};

class CurrentContext {
 public:
  CurrentContext() {
    setLinkOpener("bench", [](const ServerUrl&) { return std::make_unique<ForgetfulLink>(); });
    context_ = hlCreateContext("bench:");
    hlMakeCurrent(context_);
  }
  CurrentContext(const CurrentContext&) = delete;
  CurrentContext& operator=(const CurrentContext&) = delete;
  ~CurrentContext() { hlDestroyContext(context_); }

 private:
  HLcontext* context_;
};

void countVertices(benchmark::State& bench) {
  bench.counters["per_vertex"] = benchmark::Counter(
      static_cast<double>(bench.range(0)), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// One hlBegin .. hlEnd of so many vertices; each frame drops the last one.
void vertices(benchmark::State& bench) {
  const CurrentContext current;
  for (auto _ : bench) {
    hlClear();
    hlBegin(HL_TRIANGLES);
    for (std::int64_t i = 0; i < bench.range(0); ++i) hlVertex3f(static_cast<float>(i), 1, 2);
    hlEnd();
  }
  countVertices(bench);
}
BENCHMARK(vertices)->Arg(3'000)->Arg(300'000)->Arg(3'000'000);

void verticesWithNormals(benchmark::State& bench) {
  const CurrentContext current;
  for (auto _ : bench) {
    hlClear();
    hlBegin(HL_TRIANGLES);
    for (std::int64_t i = 0; i < bench.range(0); ++i) {
      hlNormal3f(0, 0, 1);
      hlVertex3f(static_cast<float>(i), 1, 2);
    }
    hlEnd();
  }
  countVertices(bench);
}
BENCHMARK(verticesWithNormals)->Arg(300'000);

// A triangle in each hlBegin .. hlEnd: the least favourable way.
void verticesByTriangle(benchmark::State& bench) {
  const CurrentContext current;
  for (auto _ : bench) {
    hlClear();
    for (std::int64_t i = 0; i < bench.range(0); i += 3) {
      hlBegin(HL_TRIANGLES);
      for (int k = 0; k < 3; ++k) hlVertex3f(static_cast<float>(i), 1, 2);
      hlEnd();
    }
  }
  countVertices(bench);
}
BENCHMARK(verticesByTriangle)->Arg(300'000);

void elements(benchmark::State& bench) {
  const CurrentContext current;
  const std::vector<float> positions(3'000, 1.0F);
  std::vector<HLuint> indices;
  for (std::int64_t i = 0; i < bench.range(0); ++i) indices.push_back(static_cast<HLuint>(i % 1'000));
  hlVertexPointer(3, HL_FLOAT, 0, positions.data());
  hlEnableClientState(HL_VERTEX_ARRAY);
  for (auto _ : bench) {
    hlClear();
    hlDrawElements(HL_TRIANGLES, static_cast<HLsizei>(indices.size()), HL_UNSIGNED_INT, indices.data());
  }
  countVertices(bench);
}
BENCHMARK(elements)->Arg(300'000);

// The same vertices, and the frame made into messages.
void flush(benchmark::State& bench) {
  const CurrentContext current;
  for (auto _ : bench) {
    hlBegin(HL_TRIANGLES);
    for (std::int64_t i = 0; i < bench.range(0); ++i) hlVertex3f(static_cast<float>(i), 1, 2);
    hlEnd();
    hlFlush();
  }
  countVertices(bench);
}
BENCHMARK(flush)->Arg(3'000)->Arg(300'000);

void callObject(benchmark::State& bench) {
  const CurrentContext current;
  hlNewObject(1);
  hlEndObject();
  for (auto _ : bench) {
    hlClear();
    for (std::int64_t i = 0; i < bench.range(0); ++i) hlCallObject(1);
  }
  countVertices(bench);
}
BENCHMARK(callObject)->Arg(1'000);

}  // namespace
}  // namespace hl::client
