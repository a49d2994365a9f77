// Keeps the laboratory for when there is no network, and isolates its page from others, so that it may share memory
// between threads, on servers that do not say so themselves.

const CACHE = "catoptric " + "VERSION";
const FILES = ["FILES"];

self.addEventListener("activate", (event) => {
  event.waitUntil(
    (async () => {
      const names = await caches.keys();
      await Promise.all(names.filter((name) => name !== CACHE).map((name) => caches.delete(name)));
      await self.clients.claim();
    })(),
  );
});

self.addEventListener("message", (event) => {
  const { type, without } = event.data;
  if (type === "keep") {
    // Once the page has what it needs, the rest is kept, too.
    const files = FILES.filter((name) => !without.some((folder) => name.startsWith(`${folder}/`)));
    event.waitUntil(caches.open(CACHE).then((cache) => cache.addAll(files)));
  } else if (type === "take over") {
    self.skipWaiting();
  }
});

self.addEventListener("fetch", (event) => {
  const url = new URL(event.request.url);
  if (event.request.method === "GET" && url.origin === self.location.origin) {
    event.respondWith(answer(event.request, url));
  }
});

async function answer(request, url) {
  const cache = await caches.open(CACHE);
  // What follows the path is the page's business.
  const key = url.origin + url.pathname;
  const kept = await cache.match(key);
  if (kept) {
    return isolated(kept);
  }
  const response = await fetch(request);
  if (response.ok && response.status === 200) {
    await cache.put(key, response.clone());
  }
  return isolated(response);
}

function isolated(response) {
  if (response.type === "opaque" || response.type === "opaqueredirect") {
    return response;
  }
  const headers = new Headers(response.headers);
  headers.set("Cross-Origin-Opener-Policy", "same-origin");
  headers.set("Cross-Origin-Embedder-Policy", "require-corp");
  headers.set("Cross-Origin-Resource-Policy", "same-origin");
  return new Response(response.body, { status: response.status, statusText: response.statusText, headers });
}
