// Search in a site that is opened from a folder: its worker runs in a frame, because a page of a folder cannot start one.
class FrameWorker extends EventTarget {
  constructor(url) {
    super()
    const frame = document.createElement("iframe")
    frame.hidden = true
    document.documentElement.append(frame)
    this.inner = frame.contentWindow
    this.waiting = []
    this.inner.postMessage = data => this.dispatchEvent(new MessageEvent("message", { data }))
    const script = frame.contentDocument.createElement("script")
    script.src = new URL(url, location).href
    script.onload = () => {
      const messages = this.waiting
      this.waiting = null
      messages.forEach(data => this.deliver(data))
    }
    frame.contentDocument.body.append(script)
  }
  deliver(data) { this.inner.dispatchEvent(new this.inner.MessageEvent("message", { data })) }
  postMessage(data) { this.waiting ? this.waiting.push(data) : this.deliver(data) }
  terminate() {}
}
window.Worker = FrameWorker
