#include "modules/viewer/wheel.hpp"

#include <QApplication>
#include <QGraphicsView>
#include <QWheelEvent>
#include <utility>

namespace limbcast::viewer {

Wheel::Wheel(std::function<void(float)> on_turn) : on_turn_(std::move(on_turn)) {
  for (const QWidget* window : QApplication::topLevelWidgets())
    for (const QGraphicsView* picture : window->findChildren<QGraphicsView*>())
      picture->viewport()->installEventFilter(this);
}

bool Wheel::eventFilter(QObject* /*watched*/, QEvent* event) {
  if (event->type() != QEvent::Wheel) return false;
  on_turn_(static_cast<float>(static_cast<QWheelEvent*>(event)->angleDelta().y()) /
           static_cast<float>(QWheelEvent::DefaultDeltasPerStep));
  return true;
}

}  // namespace limbcast::viewer
