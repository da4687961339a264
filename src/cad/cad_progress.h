// CadProgress: OpenCASCADE's progress as a part of a whole.
#pragma once

#include <Message_ProgressIndicator.hxx>
#include <Message_ProgressRange.hxx>
#include <functional>

namespace hl {

class CadProgress {
 public:
  /// What is begun here goes from `low` to `high` of the whole, 0..1.
  CadProgress(const std::function<void(double)>& report, double low, double high)
      : indicator_(new Indicator(report, low, high)) {}
  Message_ProgressRange begin() { return indicator_->Start(); }

 private:
  class Indicator final : public Message_ProgressIndicator {
   public:
    Indicator(const std::function<void(double)>& report, double low, double high)
        : report_(report), low_(low), high_(high) {}

   private:
    void Show(const Message_ProgressScope& /*scope*/, const Standard_Boolean /*force*/) override {
      constexpr double kStep = 0.01;
      const double now = low_ + (high_ - low_) * GetPosition();
      if (now < reported_ + kStep) return;
      reported_ = now;
      report_(now);
    }

    const std::function<void(double)>& report_;
    const double low_, high_;
    double reported_ = 0;
  };

  Handle(Indicator) indicator_;
};

}  // namespace hl
