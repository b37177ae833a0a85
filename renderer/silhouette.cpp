#include "renderer/silhouette.h"
