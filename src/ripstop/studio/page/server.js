// Requests to the server of this page, with the token of its address.
"use strict";

const Server = (() => {
  const token = new URLSearchParams(location.search).get("token") ?? "";

  /** `names` of the fields that the request is made of: Words.fields(). */
  async function answered(path, options, names) {
    let response;
    try {
      response = await fetch(path, { ...options, headers: { ...options.headers, "X-Ripstop-Token": token } });
    } catch {
      const lost = new Error("The server has ended. Start ripstop studio again and open the address that it prints.");
      lost.lost = true;
      throw lost;
    }
    const json = await response.json();
    if (response.ok) return json;
    const error = new Error(Words.shown(json.error, names));
    error.conflict = response.status === 409;
    throw error;
  }

  const get = (path, parameters = {}, names = {}) => answered(`${path}?${new URLSearchParams(parameters)}`, { method: "GET" }, names);
  const post = (path, body, names = {}) => answered(path, { method: "POST", body: JSON.stringify(body), headers: { "Content-Type": "application/json" } }, names);

  return { get, post };
})();
