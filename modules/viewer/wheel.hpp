#pragma once

#include <QObject>
#include <functional>

namespace limbcast::viewer {

/// Takes the mouse wheel over OpenCV's window, which would else magnify the pixels: Qt's highgui
/// has no option against that.
class Wheel : public QObject {
 public:
  /// For the windows that are open. `on_turn` gets by how many notches the wheel was turned, away
  /// from the user positive; a touchpad gives parts of a notch.
  explicit Wheel(std::function<void(float)> on_turn);

 private:
  bool eventFilter(QObject* watched, QEvent* event) override;

  std::function<void(float)> on_turn_;
};

}  // namespace limbcast::viewer
