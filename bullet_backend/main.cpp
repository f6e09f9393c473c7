#include "bullet_backend/bullet_engine.h"
#include "engine/worker.h"

int main() { return slipcheck::run_worker(*slipcheck::bullet::make_bullet_engine()); }
