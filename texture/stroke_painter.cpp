#include "texture/stroke_painter.h"
