// Requests to the server. Of each kind only the newest matters: an older one is cancelled there by
// the name of its job, and its answer, should it come, is dropped.

const page = Math.random().toString(36).slice(2, 10);
const running = new Map();

export class ApiFailure extends Error {
  constructor(status, error) {
    super(error?.message ?? `the server answered ${status}`);
    this.status = status;
    this.code = error?.code ?? '';
    this.place = error?.place ?? '';
  }
}

async function answerOf(response) {
  let json = null;
  try {
    json = await response.json();
  } catch {
    throw new ApiFailure(response.status, null);
  }
  if (!response.ok) throw new ApiFailure(response.status, json.error);
  return json;
}

export async function get(path) {
  return answerOf(await fetch(`api/v1/${path}`));
}

// Resolves to null if a newer request of the same kind was made meanwhile.
export async function post(kind, path, body) {
  running.get(kind)?.abort();
  const control = new AbortController();
  running.set(kind, control);
  try {
    const response = await fetch(`api/v1/${path}`, {
      method: 'POST',
      headers: { 'Content-Type': 'application/json' },
      body: JSON.stringify({ ...body, job: `${page}-${kind}` }),
      signal: control.signal,
    });
    const json = await answerOf(response);
    return running.get(kind) === control ? json : null;
  } catch (error) {
    if (error.name === 'AbortError' || error.code === 'superseded') return null;
    throw error;
  } finally {
    if (running.get(kind) === control) running.delete(kind);
  }
}
