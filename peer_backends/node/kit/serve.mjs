import { Rubbish } from './faults.mjs';

/// Answers requests until `quit` or the end of the input; the process's exit code.
export function serve(connection, worker) {
  try {
    for (let request; (request = connection.receive()); ) {
      if (request.type === 'quit') return 0;
      if (!connection.send(worker.answer(request))) return 0;
    }
    return 0;
  } catch (error) {
    if (!(error instanceof Rubbish)) throw error;
    connection.send({ type: 'failed', reason: error.message });
    return 1;
  }
}
