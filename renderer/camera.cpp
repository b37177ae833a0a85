#include "renderer/camera.h"
